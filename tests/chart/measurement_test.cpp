#include "chart/measurement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

TEST(Measurements, ReadBackAsWritten) {
  Measurement m;
  m.line = "grid, p1";
  m.setting = "tolerance 0.1, \"quoted\"";
  m.level = 3;
  m.failed = "lines\nand, commas";
  m.field_seconds = 1.0 / 3.0;
  m.memory = 1e300;
  m.picture.error = 0.1;
  m.picture.model = 0.2;
  m.field.noise = 0.3;
  const test::ScratchFolder folder;
  const auto back = read_measurements(folder.write("a.csv", measurements_csv({m, Measurement{}})));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].name(), m.name());
  EXPECT_EQ(back[0].level, 3);
  EXPECT_EQ(back[0].failed, m.failed);
  EXPECT_EQ(back[0].field_seconds, m.field_seconds);
  EXPECT_EQ(back[0].memory, m.memory);
  EXPECT_EQ(back[0].picture.error, 0.1);
  EXPECT_EQ(back[0].picture.model, 0.2);
  EXPECT_EQ(back[0].field.noise, 0.3);
  EXPECT_TRUE(std::isnan(back[0].field.error));
  EXPECT_TRUE(back[1].trusted());
}

TEST(Measurements, RefusesOtherTables) {
  const test::ScratchFolder folder;
  const std::string good = measurements_csv({Measurement{}});
  EXPECT_THROW(read_measurements(folder.path("none.csv")), InputError);
  for (const std::string& text :
       {std::string("a,b\n1,2\n"), std::string(), good + "too,few\n",
        good.substr(0, good.find('\n') + 1) + ",,x,,1,1,1,1,1,1,1,1,1,1,1,1,1\n"})
    EXPECT_THROW(read_measurements(folder.write("bad.csv", text)), InputError) << text;
}

}  // namespace
}  // namespace knotlight
