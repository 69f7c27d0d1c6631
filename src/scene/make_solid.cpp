// The order of the repairs matters: orientation needs edges that two triangles share, holes need a
// common orientation, flat triangles are turned within a closed surface, and only a closed surface
// has an inside.
#include <fmt/format.h>

#include "core/errors.h"
#include "scene/mesh_reader.h"
#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

// Crossings of thin folds at a few places hardly change the light; more means that inside and
// outside are not well defined.
constexpr double max_crossing_fraction = 0.01;

void check_finite(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError("mesh has no triangles, expected a solid");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite())
      throw InputError(fmt::format("vertex {} of the mesh is not finite", v));
  }
}

void check_flat(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!(mesh.area(t) > 0.0)) {
      throw InputError(fmt::format("triangle without area at {} cannot be taken out of the surface",
                                   coordinates(centroid(mesh, t))));
    }
  }
}

void check_crossings(const TriangleMesh& mesh, std::vector<std::string>& warnings) {
  const std::size_t all = mesh.triangles.size();
  const auto pairs = intersecting_triangles(mesh, all);
  if (pairs.empty()) return;
  std::vector<bool> crosses(all, false);
  for (const auto& [a, b] : pairs) crosses[a] = crosses[b] = true;
  std::size_t count = 0;
  for (const bool c : crosses) count += c ? 1 : 0;
  const double fraction = static_cast<double>(count) / static_cast<double>(all);
  const bool too_many = fraction > max_crossing_fraction || pairs.size() == all;
  const std::string what = fmt::format("{} of {} triangles cross others, e.g. around {}", count,
                                       all, coordinates(centroid(mesh, pairs.front().first)));
  if (too_many) {
    throw InputError(
        fmt::format("{}, expected a surface that does not cross itself (up to {:g} % "
                    "are tolerated)",
                    what, 100.0 * max_crossing_fraction));
  }
  warnings.push_back(what);
}

}  // namespace

TriangleMesh make_solid(TriangleMesh mesh, std::vector<std::string>& warnings) {
  check_finite(mesh);
  if (!mesh.colours.empty())
    warnings.push_back("vertex colours left out: they belong to diffuse objects");
  mesh.colours.clear();
  drop_unused_vertices(mesh);
  const double tolerance = same_position_fraction * bounds(mesh).largest_extent();
  const std::size_t given = mesh.triangles.size();
  merge_vertices(mesh, tolerance);
  if (mesh.triangles.empty()) throw InputError("mesh has no area, expected a solid");
  std::size_t without_area = given - mesh.triangles.size();

  const std::size_t turned = orient_consistently(mesh);
  const std::size_t filled = fill_holes(mesh);
  without_area += remove_flat_triangles(mesh, tolerance);
  check_flat(mesh);
  const auto warn = [&warnings](const char* what, std::size_t count) {
    if (count > 0) warnings.push_back(fmt::format("{}: {}", what, count));
  };
  warn("triangles without area taken out", without_area);
  warn("triangles turned to face like their neighbours", turned);
  warn("small holes closed", filled);
  orient_outward(mesh, tolerance, warnings);
  check_crossings(mesh, warnings);
  return mesh;
}

}  // namespace knotlight
