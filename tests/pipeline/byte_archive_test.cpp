#include "pipeline/byte_archive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace knotlight {

struct Item {
  bool flag = false;
  double number = 0.0;
  std::string text;
};

template <class Archive>
void members(Archive& archive, Item& item) {
  archive(item.flag, item.number, item.text);
}

namespace {

TEST(ByteArchive, WhatIsWrittenIsRead) {
  std::vector<Item> items = {{true, std::nan(""), "a\nb"}, {false, -0.0, ""}};
  std::vector<std::pair<std::string, double>> figures = {
      {"x", std::numeric_limits<double>::infinity()}};
  Eigen::VectorXd values(3);
  values << 1.0, 2.5, -1e300;
  ByteWriter writer;
  writer(items, figures, values);

  const std::string& bytes = writer.bytes();
  std::vector<Item> items_read(5);
  std::vector<std::pair<std::string, double>> figures_read;
  Eigen::VectorXd values_read;
  ByteReader reader(bytes.data(), bytes.data() + bytes.size());
  reader(items_read, figures_read, values_read);
  EXPECT_TRUE(reader.at_end());
  ASSERT_EQ(items_read.size(), 2U);
  EXPECT_TRUE(items_read[0].flag);
  EXPECT_TRUE(std::isnan(items_read[0].number));
  EXPECT_EQ(items_read[0].text, "a\nb");
  EXPECT_TRUE(std::signbit(items_read[1].number));
  EXPECT_EQ(figures_read, figures);
  EXPECT_EQ(values_read, values);

  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader cut(bytes.data(), bytes.data() + size);
    EXPECT_THROW(cut(items_read, figures_read, values_read), InputError) << size;
  }
}

// A count of more things than there are bytes asks for no memory.
TEST(ByteArchive, AbsurdCounts) {
  for (std::uint64_t count : {std::uint64_t{9}, ~std::uint64_t{0}}) {
    ByteWriter writer;
    writer(count, count);
    const char* begin = writer.bytes().data();
    std::string text;
    Eigen::VectorXd values;
    std::vector<Item> items;
    EXPECT_THROW(ByteReader(begin, begin + 16)(text), InputError);
    EXPECT_THROW(ByteReader(begin, begin + 16)(values), InputError);
    EXPECT_THROW(ByteReader(begin, begin + 16)(items), InputError);
  }
}

}  // namespace
}  // namespace knotlight
