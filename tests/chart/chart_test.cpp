// The whole command on a small scene.
#include "chart/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "chart/front.h"
#include "core/errors.h"
#include "report/csv.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

constexpr const char* ball = R"(units: mm
camera: {type: orthographic, from: [0, 0, 5], to: [0, 0, 0], up: [0, 1, 0], width: 2.4, resolution: [48, 48], samples: 4}
lights: [{type: point, position: [3, 0, 3], intensity: 18}]
materials: {wax: {type: translucent, sigma_a: 0.1, sigma_s: 5}}
objects: [{name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax}]
solver: {photons: 50000}
)";

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

RunContext quiet_run() {
  RunOptions options;
  options.quiet = true;
  return {options, false};
}

// One level of every line; the truth to 4 % per block.
const ChartOptions small{1e6, 1, 2, 0.04};

const Measurement& line(const std::vector<Measurement>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& m) { return m.line == name; });
  if (found == all.end()) throw std::runtime_error("no line " + name);
  return *found;
}

void expect_what_the_methods_are_known_for(const std::vector<Measurement>& all) {
  const Measurement& grid = line(all, "grid");
  EXPECT_TRUE(grid.trusted()) << grid.failed;
  // A coarse grid's picture is within 10 % of path tracing; mean_intensity, the thesis's last step,
  // is off by tens of per cent, and that is the model's fault.
  EXPECT_LT(grid.picture.error, 0.1);
  const Measurement& mean = line(all, "grid, mean_intensity");
  EXPECT_GT(mean.picture.error, 0.2);
  EXPECT_GT(mean.picture.model, 0.8 * mean.picture.error);
  // Beyond P1 only a part of the field is solved for.
  EXPECT_TRUE(std::isnan(grid.field.error));
  const Measurement& p1 = line(all, "grid, p1");
  EXPECT_LT(p1.field.error, 0.05);
  EXPECT_EQ(p1.field.model, 0.0);
  EXPECT_GT(line(all, "grid, boundary_flux").field.model, 0.03);
  // One path per pixel: all of its error is noise.
  const Measurement& paths = line(all, path_tracing_line);
  EXPECT_GT(paths.picture.noise, 0.05);
  EXPECT_LT(paths.picture.noise, 3.0 * paths.picture.error);
  for (const Measurement& m : all)
    if (m.trusted()) {
      EXPECT_GT(m.picture_seconds, 0.0) << m.line;
    }
}

void expect_a_page_that_stands_alone(const std::string& page) {
  for (const char* part : {"<!DOCTYPE html>", "Picture: methods and rivals", "front",
                           "Does tolerance choose well?", "path tracing", "<svg", "</html>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* fetch : {"<link", "<script", "src=\"http"})
    EXPECT_EQ(page.find(fetch), std::string::npos) << fetch;
}

TEST(Chart, MeasuresOnceAndGoesOnWhereItWasStopped) {
  const test::ScratchFolder scratch;
  const std::string scene = scratch.write("ball.yaml", ball);
  const std::string table = scratch.path("out/measurements.csv");
  RunContext run = quiet_run();
  chart_scenes({scene}, scratch.path("out"), small, run);
  std::vector<Measurement> all = read_measurements(table);
  expect_what_the_methods_are_known_for(all);
  expect_a_page_that_stands_alone(contents(scratch.path("out/index.html")));

  // What was measured is not measured again; what is missing is.
  const std::string before = contents(table);
  chart_scenes({scene}, scratch.path("out"), small, run);
  EXPECT_EQ(contents(table), before);
  const Measurement last = all.back();
  all.pop_back();
  scratch.write("out/measurements.csv", measurements_csv(all));
  chart_scenes({scene}, scratch.path("out"), small, run);
  const std::vector<Measurement> after = read_measurements(table);
  ASSERT_EQ(after.size(), all.size() + 1);
  EXPECT_EQ(after.back().name(), last.name());
  EXPECT_EQ(after.back().picture.error, last.picture.error);

  // What another program measured stands beside them, and is not taken for ours.
  Measurement elements;
  elements.line = finite_elements_line;
  elements.setting = "so many tetrahedra";
  elements.field_seconds = 1e-4;
  elements.field.error = 1e-4;
  scratch.write("out/finite_elements.csv", measurements_csv({elements}));
  chart_scenes({scene}, scratch.path("out"), small, run);
  const std::string page = contents(scratch.path("out/index.html"));
  EXPECT_NE(page.find("<td>so many tetrahedra</td>"), std::string::npos);
  EXPECT_NE(contents(scratch.path("out/field.svg")).find(finite_elements_line), std::string::npos);
  EXPECT_EQ(contents(scratch.path("out/picture-methods.svg")).find(finite_elements_line),
            std::string::npos);
  EXPECT_EQ(contents(table).find(finite_elements_line), std::string::npos);
  scratch.write("out/finite_elements.csv", "line\n");
  EXPECT_THROW(chart_scenes({scene}, scratch.path("out"), small, run), InputError);
  scratch.write("out/finite_elements.csv", measurements_csv({}));

  std::string other = ball;
  other.replace(other.find("sigma_s: 5"), 10, "sigma_s: 6");
  try {
    chart_scenes({scratch.write("other.yaml", other)}, scratch.path("out"), small, run);
    FAIL() << "took them";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("another scene"), std::string::npos) << error.what();
  }
}

// For other programs: where the field is compared, and what it is there.
void expect_points_of_the_ball(const std::string& file) {
  const auto rows = read_csv(file);
  ASSERT_EQ(rows.size(), 1U + 2048U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"x", "y", "z", "area", "U_d"}));
  double area = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Vec3 x(std::stod(rows[i][0]), std::stod(rows[i][1]), std::stod(rows[i][2]));
    EXPECT_NEAR(x.norm(), 1.0, 1e-9);
    area += std::stod(rows[i][3]);
    EXPECT_GT(std::stod(rows[i][4]), 0.0);
  }
  EXPECT_NEAR(area, 4.0 * std::numbers::pi, 1e-9);
}

TEST(Chart, SeveralScenesShareATable) {
  const test::ScratchFolder scratch;
  RunContext run = quiet_run();
  ChartOptions options = small;
  options.budget = 0.5;  // hardly anything: what is left out is said
  chart_scenes({scratch.write("a.yaml", ball), scratch.write("b.yaml", ball)}, scratch.path("out"),
               options, run);
  const std::string table = contents(scratch.path("out/ratios.csv"));
  EXPECT_EQ(table.substr(0, table.find('\n')), "of,error,seconds or ratio,a,b");
  EXPECT_NE(table.find("path tracing / knotlight"), std::string::npos);
  expect_points_of_the_ball(scratch.path("out/a/points.csv"));
  EXPECT_NE(table.find("field,2 %,finite elements / knotlight,not measured,not measured"),
            std::string::npos)
      << table;
  EXPECT_NE(contents(scratch.path("out/a/index.html")).find("left out for lack of time"),
            std::string::npos);
}

TEST(Chart, RefusesAPictureWithoutBlocks) {
  const test::ScratchFolder scratch;
  std::string tiny = ball;
  tiny.replace(tiny.find("[48, 48]"), 8, "[8, 8]");
  RunContext run = quiet_run();
  EXPECT_THROW(chart_scenes({scratch.write("tiny.yaml", tiny)}, scratch.path("out"), small, run),
               InputError);
}

}  // namespace
}  // namespace knotlight
