#include "report/csv.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "support/scene_files.h"

#include <cmath>
#include <limits>

namespace knotlight {
namespace {

TEST(Csv, PlainFieldsStandAsTheyAre) {
  EXPECT_EQ(csv_text({"model", "error"}, {{"photon_map", "0.01"}, {"x y", ""}}),
            "model,error\nphoton_map,0.01\nx y,\n");
}

TEST(Csv, SpecialFieldsAreQuoted) {
  EXPECT_EQ(csv_line({"a,b", "say \"so\"", "two\nlines", "plain"}),
            "\"a,b\",\"say \"\"so\"\"\",\"two\nlines\",plain\n");
}

TEST(Csv, NumbersReadBackAsTheSameNumber) {
  for (const double value : {1.0 / 3.0, 1e-300, -0.1, 6.02214076e23, 0.0})
    EXPECT_EQ(std::stod(csv_number(value)), value);
  EXPECT_EQ(csv_number(0.01), "0.01");
  EXPECT_EQ(csv_number(std::nan("")), "nan");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Csv, ReadsBackWhatItWrites) {
  const std::vector<std::vector<std::string>> rows = {
      {"a", "b"}, {"with, comma", "with \"quotes\""}, {"two\nlines", ""}};
  const test::ScratchFolder folder;
  const std::string text = csv_text(rows[0], {rows[1], rows[2]});
  EXPECT_EQ(read_csv(folder.write("a.csv", text)), rows);
  // Neither the last line's end nor another system's line ends matter.
  EXPECT_EQ(read_csv(folder.write("b.csv", "x,y\r\n1,2")),
            (std::vector<std::vector<std::string>>{{"x", "y"}, {"1", "2"}}));
  EXPECT_THROW(read_csv(folder.write("c.csv", "a,\"b\n")), InputError);
  EXPECT_THROW(read_csv(folder.path("none.csv")), InputError);
}

}  // namespace
}  // namespace knotlight
