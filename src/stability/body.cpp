#include "stability/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double ring = 1.0;   // radius of the torus's circle
constexpr double tube = 0.35;  // and of its tube
// Triangles of the mesh that stands for the torus: chords are off by (pi / across)^2 / 2 of `tube`.
constexpr int around = 192, across = 96;

// Steps along a segment are at least this long: what is thinner does not part two points.
constexpr double least_step = 1e-3;
// Points on the surface are off it by rounding.
constexpr double on_surface = 1e-9;

SurfacePoint torus_point(double phi, double theta) {
  const Vec3 out(std::cos(phi), std::sin(phi), 0.0);
  const Vec3 n = std::cos(theta) * out + std::sin(theta) * Vec3::UnitZ();
  return {ring * out + tube * n, n};
}

// theta with (theta + (tube/ring) sin theta) / (2 pi) = v: the area up to it is the share v.
double torus_angle(double v) {
  double theta = 2.0 * pi * v;
  constexpr int newton_steps = 12;  // quadratic convergence from an error of at most 0.35
  for (int i = 0; i < newton_steps; ++i)
    theta -= (theta + tube / ring * std::sin(theta) - 2.0 * pi * v) /
             (1.0 + tube / ring * std::cos(theta));
  return theta;
}

TriangleMesh torus_mesh() {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      mesh.vertices.push_back(torus_point(2.0 * pi * i / around, 2.0 * pi * j / across).position);
      const auto at = [&](int a, int b) {
        return static_cast<std::uint32_t>((i + a) % around * across + (j + b) % across);
      };
      mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  return mesh;
}

double fraction(double x) {
  return x - std::floor(x);
}

}  // namespace

Body unit_ball() {
  Body body;
  body.name = "sphere";
  body.area = 4.0 * pi;
  body.point = [](double u, double v) {
    const double z = 2.0 * u - 1.0;
    const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
    const Vec3 n(s * std::cos(2.0 * pi * v), s * std::sin(2.0 * pi * v), z);
    return SurfacePoint{n, n};
  };
  body.depth = [](const Vec3& x) { return 1.0 - x.norm(); };
  body.shape = Sphere{};
  body.foot = body.point(0.8, 0.1);
  return body;
}

Body thin_torus() {
  Body body;
  body.name = "torus";
  body.half_extent = ring + tube;
  body.area = 4.0 * pi * pi * ring * tube;
  body.point = [](double u, double v) { return torus_point(2.0 * pi * u, torus_angle(v)); };
  body.depth = [](const Vec3& x) {
    return tube - std::hypot(std::hypot(x.x(), x.y()) - ring, x.z());
  };
  body.shape = torus_mesh();
  body.foot = torus_point(0.6, 0.7);
  return body;
}

SpreadKnots spread_over(const Body& body, std::size_t count) {
  constexpr double plastic = 1.324717957244746;  // root of x^3 = x + 1
  const auto n = static_cast<Eigen::Index>(count);
  SpreadKnots knots{Points(3, n), Points(3, n), body.area};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double turn = static_cast<double>(i);
    const SurfacePoint p =
        body.point(fraction(0.5 + turn / plastic), fraction(0.5 + turn / (plastic * plastic)));
    knots.positions.col(i) = p.position;
    knots.normals.col(i) = p.normal;
  }
  return knots;
}

BodyQueries queries(const Body& body) {
  BodyQueries q;
  const auto depth = body.depth;
  q.inside = [depth](const Vec3& x) { return depth(x) > 0.0; };
  q.connected = [depth](const Vec3& a, const Vec3& b) {
    const double length = (b - a).norm();
    for (double t = 0.0; t < length;) {
      const double d = depth(a + t / length * (b - a));
      if (d < -on_surface) return false;
      t += std::max(d, least_step);
    }
    return true;
  };
  q.thickness = [depth](const Vec3& x, const Vec3& inward) {
    double t = least_step;
    for (double d = depth(x + t * inward); d > 0.0; d = depth(x + t * inward))
      t += std::max(d, least_step);
    return t;
  };
  return q;
}

}  // namespace knotlight
