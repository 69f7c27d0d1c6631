#include "photon/ball_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr int line_count = 256;

// The lines pass the centre by this much of the radius, and at least by this many skip distances of
// the ray caster, in a generic direction: a centre on an edge, a corner or a mesh vertex would send
// every line exactly through it, and rounding would decide what each of them meets. It costs up to
// 2e-4 of the ball.
constexpr double offset_in_radii = 1e-4;
constexpr double offset_in_skips = 20.0;

// A hemisphere of the Fibonacci lattice (equal areas, golden-angle turns), as lines through the
// origin. Around a generic axis: no line lies in the planes and edges that modelled shapes have.
std::array<Vec3, line_count> make_lines() {
  const Frame frame(Vec3(0.4743, 0.2961, 0.8291).normalized());
  const double golden_angle = pi * (3.0 - std::sqrt(5.0));
  std::array<Vec3, line_count> lines;
  for (int i = 0; i < line_count; ++i) {
    const double z = (i + 0.5) / line_count;
    const double rho = std::sqrt(1.0 - z * z);
    const double phi = golden_angle * i;
    lines[static_cast<std::size_t>(i)] =
        frame.to_world({rho * std::cos(phi), rho * std::sin(phi), z});
  }
  return lines;
}

// Integral of u^2 du over the parts inside the object of the line x + u d, u in (-r, r). The line
// is followed from its end behind x, so that a surface through x is a crossing like any other and
// rounding of x off it does not matter.
double line_moment(const Vec3& x, const Vec3& d, double r, const RayCaster& caster,
                   std::uint32_t object) {
  const Ray ray{x - r * d, d, std::numeric_limits<double>::infinity()};
  const auto moment = [r](double t_begin, double t_end) {
    const double u1 = std::min(t_begin, 2.0 * r) - r;
    const double u2 = std::min(t_end, 2.0 * r) - r;
    return (u2 * u2 * u2 - u1 * u1 * u1) / 3.0;
  };
  double sum = 0.0;
  double entered = 0.0;  // inside from the start, if the first crossing leaves
  for (const RayCaster::Crossing& crossing : caster.crossings(ray, object)) {
    if (crossing.leaving)
      sum += moment(entered, crossing.t);
    else
      entered = crossing.t;
  }
  return sum;
}

}  // namespace

double ball_volume_inside(const Vec3& x, double r, const RayCaster& caster, std::uint32_t object) {
  const double to_surface = (caster.nearest_surface_point(x, object).position - x).norm();
  if (to_surface >= r) return 4.0 / 3.0 * pi * r * r * r;
  static const std::array<Vec3, line_count> lines = make_lines();
  const double offset = std::max(offset_in_radii * r, offset_in_skips * caster.skip_distance());
  const Vec3 center = x + offset * Vec3(0.6137, -0.7310, 0.2983);  // unit to 4 digits
  double sum = 0.0;
  for (const Vec3& d : lines) sum += line_moment(center, d, r, caster, object);
  return 2.0 * pi / line_count * sum;
}

}  // namespace knotlight
