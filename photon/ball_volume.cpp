#include "photon/ball_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Two rings of lines, the second with the first one's heights and half a turn on: where their
// masses agree the surface looks alike all around its normal (flat, or evenly curved), and the few
// lines, which stratify the height, are enough.
constexpr int ring_lines = 16;
// Of the whole ball's mass, for the masses of the two rings to agree: a sphere or a torus of ten
// radii of the ball stays below, an edge within the ball does not.
constexpr double ring_agreement = 0.004;
constexpr int full_lines = 256;

// The lines pass the centre by this much of the radius, and at least by this many skip distances of
// the ray caster, in a generic direction: a centre on an edge, a corner or a mesh vertex would send
// every line exactly through it, and rounding would decide what each of them meets. It costs up to
// 2e-4 of the ball.
constexpr double offset_in_radii = 1e-4;
constexpr double offset_in_skips = 20.0;

// A hemisphere of the Fibonacci lattice (equal areas, golden-angle turns) about +z, as lines
// through the origin; `turn` in radians.
template <std::size_t N>
std::array<Vec3, N> make_lines(double turn) {
  const double golden_angle = pi * (3.0 - std::sqrt(5.0));
  std::array<Vec3, N> lines;
  for (std::size_t i = 0; i < N; ++i) {
    const double z = (static_cast<double>(i) + 0.5) / N;
    const double rho = std::sqrt(1.0 - z * z);
    const double phi = turn + golden_angle * static_cast<double>(i);
    lines[i] = Vec3(rho * std::cos(phi), rho * std::sin(phi), z);
  }
  return lines;
}

// A ball on a line through its centre, s = signed distance from the centre in radii:
// int s^2 K ds and int s^3 K ds from 0 to s.
struct LineMoments {
  double mass, first;
};
LineMoments line_moments(RadialKernel kernel, double s) {
  const double s2 = s * s;
  const double s3 = s2 * s;
  if (kernel == RadialKernel::ball) return {s3 / 3.0, s2 * s2 / 4.0};
  return {s3 * (1.0 / 3.0 - s2 * (2.0 / 5.0 - s2 / 7.0)),
          s2 * s2 * (1.0 / 4.0 - s2 * (1.0 / 3.0 - s2 / 8.0))};
}

struct KernelBall {
  Vec3 center;
  double radius;
  RadialKernel kernel;

  double whole_mass() const {
    return 4.0 * pi * radius * radius * radius * line_moments(kernel, 1.0).mass;
  }
};

// Sum over lines of the integrals over their parts inside the object, the line's share of the
// hemisphere included. Each is followed from its end behind the centre, so that a surface through
// the centre is a crossing like any other and rounding of the centre off it does not matter.
template <std::size_t N>
KernelMoments sum_over(const std::array<Vec3, N>& lines, const Frame& frame, const KernelBall& ball,
                       const RayCaster& caster, std::uint32_t object) {
  const double r = ball.radius;
  KernelMoments sum;
  for (const Vec3& line : lines) {
    const Vec3 d = frame.to_world(line);
    LineMoments inside{0.0, 0.0};
    const auto add = [&](double t_begin, double t_end) {
      const LineMoments a = line_moments(ball.kernel, std::min(t_begin / r, 2.0) - 1.0);
      const LineMoments b = line_moments(ball.kernel, std::min(t_end / r, 2.0) - 1.0);
      inside.mass += b.mass - a.mass;
      inside.first += b.first - a.first;
    };
    double entered = 0.0;  // inside from the start, if the first crossing leaves
    for (const RayCaster::Crossing& crossing : caster.crossings(
             {ball.center - r * d, d, std::numeric_limits<double>::infinity()}, object)) {
      if (crossing.leaving)
        add(entered, crossing.t);
      else
        entered = crossing.t;
    }
    sum.mass += inside.mass;
    sum.first += inside.first * d;
  }
  const double solid_angle = 2.0 * pi / N;
  return {solid_angle * r * r * r * sum.mass, solid_angle * r * r * r * r * sum.first};
}

}  // namespace

double kernel_value(RadialKernel kernel, double s_squared) {
  if (kernel == RadialKernel::ball) return 1.0;
  return (1.0 - s_squared) * (1.0 - s_squared);
}

KernelMoments kernel_moments_inside(const Vec3& x, double r, RadialKernel kernel,
                                    const RayCaster& caster, std::uint32_t object) {
  const SurfacePoint surface = caster.nearest_surface_point(x, object);
  KernelBall ball{x, r, kernel};
  if ((surface.position - x).norm() >= r) return {ball.whole_mass(), Vec3::Zero()};
  const double offset = std::max(offset_in_radii * r, offset_in_skips * caster.skip_distance());
  ball.center += offset * Vec3(0.6137, -0.7310, 0.2983);  // unit to 4 digits

  constexpr double first_turn = 0.4;  // no line along the frame's axes
  static const auto ring = make_lines<ring_lines>(first_turn);
  static const auto ring_turned = make_lines<ring_lines>(first_turn + pi);
  const Frame around_normal(surface.normal);
  const KernelMoments a = sum_over(ring, around_normal, ball, caster, object);
  const KernelMoments b = sum_over(ring_turned, around_normal, ball, caster, object);
  if (std::abs(a.mass - b.mass) < ring_agreement * ball.whole_mass())
    return {0.5 * (a.mass + b.mass), 0.5 * (a.first + b.first)};

  // Around a generic axis: no line lies in the planes and edges that modelled shapes have.
  static const Frame generic(Vec3(0.4743, 0.2961, 0.8291).normalized());
  static const auto lines = make_lines<full_lines>(0.0);
  return sum_over(lines, generic, ball, caster, object);
}

double ball_volume_inside(const Vec3& x, double r, const RayCaster& caster, std::uint32_t object) {
  return kernel_moments_inside(x, r, RadialKernel::ball, caster, object).mass;
}

}  // namespace knotlight
