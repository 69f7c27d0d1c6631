#include "grid/cell_sampling.h"

#include <gtest/gtest.h>

#include "grid/grid_cases.h"

namespace knotlight {
namespace {

using namespace grid_cases;

AxisLines lines(const TriangleMesh& mesh) {
  const std::array<int, 3> n{4, 4, 4};
  return {ScanLines(mesh, n, 0), ScanLines(mesh, n, 1), ScanLines(mesh, n, 2)};
}

Moments volume_of(const CellSample& sample) {
  Moments m{};
  for (int line = 0; line < 16; ++line)
    for (const LinePart& part : sample.lines[static_cast<std::size_t>(line)])
      add_line_part(m, sample.axis, line, part, Vec3::Zero());
  return m;
}

// A whole cell's quadrature is exact for all 27 moments.
TEST(CellSampling, WholeCell) {
  CellSample s;
  sample_cell(lines(box_mesh(Vec3(0.5, 0.5, 0.5), Vec3(3.5, 3.5, 3.5))), {1, 1, 1}, Vec3(0, 1, 0),
              s);
  EXPECT_EQ(s.inside, all_places);
  EXPECT_EQ(s.parts.size(), 1U);
  for (const auto link : s.links) EXPECT_EQ(link, 0xffff);
  const Moments m = volume_of(s), exact = full_cell_moments();
  for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(m[i], exact[i], 1e-14);
}

// A gap much narrower than the distance of the places divides a cell in two.
TEST(CellSampling, NarrowGap) {
  TriangleMesh mesh = box_mesh(Vec3(0.5, 0.5, 0.5), Vec3(3.5, 3.5, 1.4999));
  append(mesh, box_mesh(Vec3(0.5, 0.5, 1.5001), Vec3(3.5, 3.5, 3.5)));
  CellSample s;
  sample_cell(lines(mesh), {1, 1, 1}, Vec3(0, 0, 2), s);
  EXPECT_EQ(s.inside, all_places);
  ASSERT_EQ(s.parts.size(), 2U);
  EXPECT_EQ(s.parts[0], 0x00000000ffffffffULL);
  EXPECT_EQ(s.parts[1], 0xffffffff00000000ULL);
  EXPECT_TRUE(s.split());
  EXPECT_NEAR(total(volume_of(s)), 1.0 - 2e-4, 1e-12);
}

// A slanted surface: the volume under a plane is exact where lines cross it in the cell.
TEST(CellSampling, SlantedSurface) {
  TriangleMesh mesh = box_mesh(Vec3(0.2, 0.2, 0.2), Vec3(3.8, 3.8, 1.5));
  for (Vec3& v : mesh.vertices)
    if (v.z() > 1.0) v.z() += 0.3 * (v.x() - 1.5) + 0.2 * (v.y() - 1.5);
  CellSample s;
  sample_cell(lines(mesh), {1, 1, 1}, Vec3(0.3, 0.2, 1), s);
  EXPECT_EQ(s.axis, 2);
  EXPECT_FALSE(s.split());
  EXPECT_NEAR(total(volume_of(s)), 0.5, 1e-12);
}

}  // namespace
}  // namespace knotlight
