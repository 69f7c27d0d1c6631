#include "report/csv.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace knotlight
