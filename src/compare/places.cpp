#include "compare/places.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "photon/irradiance.h"
#include "trace/camera_rays.h"

namespace knotlight {
namespace {

constexpr std::size_t line_candidates = 1500;  // places on the surface that lines may start from
constexpr int rays_per_candidate = 32;         // to the lights, for a ranking that holds
// In transport mean free paths: a line shorter than the first passes through a rim, where no depth
// can be told; beyond the second next to no light is left to compare.
constexpr double shortest_line = 1.0, longest_line = 12.0;

// Cells of the truth: fine enough that U_d hardly bends within one, ...
constexpr double truth_cell = 0.3;  // transport mean free paths
// ... but few enough, in the object and in its box, that each is crossed by many photons and that
// the sums of a batch stay small (128 bytes a cell).
constexpr double most_cells_inside = 3e4, most_cells_in_box = 4e5;

constexpr int slice_cells = 100;         // along the longer side of a slice's picture
constexpr double slice_thickness = 0.4;  // transport mean free paths: below the depth of the
                                         // first layer of scattered light

}  // namespace

std::size_t SeenSurface::pixels() const {
  std::size_t sum = 0;
  for (const Part& part : parts) sum += part.pixels.size();
  return sum;
}

std::size_t SeenSurface::most_seen() const {
  const auto most = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.pixels.size() < b.pixels.size();
  });
  return static_cast<std::size_t>(most - parts.begin());
}

SeenSurface see_surface(const PreparedScene& prepared) {
  const Camera& camera = prepared.scene.camera;
  const CameraRays rays(camera);
  SeenSurface seen{camera.width_px, camera.height_px, {}};
  seen.parts.resize(prepared.translucent.size());
  std::vector<std::vector<SurfacePoint>> points(prepared.translucent.size());
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x) {
      const auto hit = prepared.caster->nearest(rays.ray(x + 0.5, y + 0.5));
      if (!hit) continue;
      const auto found =
          std::find(prepared.translucent.begin(), prepared.translucent.end(), hit->object);
      if (found == prepared.translucent.end()) continue;
      const auto part = static_cast<std::size_t>(found - prepared.translucent.begin());
      seen.parts[part].pixels.push_back(static_cast<std::size_t>(y) * camera.width_px + x);
      points[part].push_back({hit->position, hit->normal});
    }
  for (std::size_t i = 0; i < points.size(); ++i) seen.parts[i].surface = columns(points[i]);
  return seen;
}

std::array<InwardLine, 3> choose_lines(const PreparedScene& prepared, std::uint32_t object,
                                       std::uint64_t seed) {
  const Object& item = prepared.scene.objects[object];
  const double mean_free_path = 1.0 / item.translucent()->medium(0).sigma_tr();
  std::vector<InwardLine> lines;
  const std::vector<SurfacePoint> starts =
      stratified_surface_points(item.shape, line_candidates, true, seed, Stream::check_points);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Ray inward{starts[i].position, -starts[i].normal};
    const auto far_side = prepared.caster->nearest(inward, object);
    if (!far_side) continue;
    Rng rng(seed, Stream::irradiance_rays, i);
    lines.push_back({"", starts[i].position, inward.direction,
                     std::min(far_side->t, longest_line * mean_free_path),
                     entering_irradiance(prepared.scene, *prepared.caster, 0, object, starts[i],
                                         rays_per_candidate, rng)});
  }
  if (lines.empty()) throw std::runtime_error("no line leads into object '" + item.name + "'");
  // In a body that is thin everywhere the rule on length would leave nothing to choose from.
  const auto too_short = [&](const InwardLine& line) {
    return line.length < shortest_line * mean_free_path;
  };
  if (!std::all_of(lines.begin(), lines.end(), too_short)) std::erase_if(lines, too_short);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const InwardLine& a, const InwardLine& b) { return a.entered > b.entered; });

  double total = 0.0;
  for (const InwardLine& line : lines) total += line.entered;
  std::size_t half = 0;
  for (double sum = 0.0; half + 1 < lines.size(); ++half) {
    sum += lines[half].entered;
    if (sum >= 0.5 * total) break;
  }
  std::array<InwardLine, 3> chosen = {lines.front(), lines[half], lines[lines.size() * 9 / 10]};
  chosen[0].name = "from the brightest place";
  chosen[1].name = "from a place of middling light";
  chosen[2].name = "from the shade";
  return chosen;
}

FluxGrid truth_grid(const Object& object) {
  const Bounds box = bounds(object.shape);
  const Vec3 size = box.hi - box.lo;
  const double h = std::max({truth_cell / object.translucent()->medium(0).sigma_tr(),
                             std::cbrt(volume(object.shape) / most_cells_inside),
                             std::cbrt(size.prod() / most_cells_in_box)});
  FluxGrid grid{box.lo, box.hi, {}};
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    grid.n[axis] = std::max(1, static_cast<int>(std::ceil(size[a] / h)));
    grid.lo[a] = box.center()[a] - 0.5 * h * grid.n[axis];
    grid.hi[a] = box.center()[a] + 0.5 * h * grid.n[axis];
  }
  return grid;
}

Slice choose_slice(const Object& object, const Camera& camera, const Vec3& through) {
  Slice slice;
  const Vec3 view = camera.to - camera.from;
  int across = 0;
  view.cwiseAbs().maxCoeff(&across);
  slice.across = across;
  // The picture stands as the camera would see it, as far as axes allow: z up, or y if z is cut.
  slice.down = across == 2 ? 1 : 2;
  slice.right = 3 - across - slice.down;
  const Bounds box = bounds(object.shape);
  const double cell =
      std::max(box.hi[slice.right] - box.lo[slice.right], box.hi[slice.down] - box.lo[slice.down]) /
      slice_cells;
  const double thickness =
      std::max(cell, slice_thickness / object.translucent()->medium(0).sigma_tr());
  slice.grid.lo = box.lo;
  slice.grid.hi = box.hi;
  slice.grid.lo[across] = through[across] - 0.5 * thickness;
  slice.grid.hi[across] = through[across] + 0.5 * thickness;
  for (const int a : {slice.right, slice.down})
    slice.grid.n[static_cast<std::size_t>(a)] =
        std::max(1, static_cast<int>(std::lround((box.hi[a] - box.lo[a]) / cell)));
  return slice;
}

}  // namespace knotlight
