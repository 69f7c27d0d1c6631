// Bodies, check points and exact solutions for the tests of bkm/. Points here are analytic, so that
// these tests judge the boundary knot method and nothing else.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "bkm/thesis_solver.h"
#include "core/rng.h"

namespace knotlight::bkm_cases {

struct Surface {
  Points points;   // 3 x N
  Points normals;  // 3 x N, outward unit
};

// N nearly equidistant points of the ellipsoid with the given half axes about the origin: the
// Fibonacci lattice of the unit sphere, stretched. The normal of F(x) = |x / axes|^2 is grad F.
inline Surface ellipsoid(int count, const Vec3& axes) {
  Surface s{Points(3, count), Points(3, count)};
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double phi = 2.0 * std::numbers::pi * i / std::numbers::phi;
    const double rho = std::sqrt(1.0 - z * z);
    const Vec3 on_sphere(rho * std::cos(phi), rho * std::sin(phi), z);
    s.points.col(i) = on_sphere.cwiseProduct(axes);
    s.normals.col(i) = on_sphere.cwiseQuotient(axes).normalized();
  }
  return s;
}
inline Surface sphere(int count, double radius = 1.0) {
  return ellipsoid(count, Vec3::Constant(radius));
}

// Torus about the z axis; around x along points; `turn` shifts the lattice by parts of a cell.
inline Surface torus(int around, int along, double major, double minor, double turn = 0.0) {
  Surface s{Points(3, around * along), Points(3, around * along)};
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double u = 2.0 * std::numbers::pi * (i + turn) / around;
      const double v = 2.0 * std::numbers::pi * (j + 0.5 * (i % 2) + turn) / along;
      const Vec3 out(std::cos(u), std::sin(u), 0.0);
      const Vec3 n = std::cos(v) * out + std::sin(v) * Vec3::UnitZ();
      s.points.col(i * along + j) = major * out + minor * n;
      s.normals.col(i * along + j) = n;
    }
  return s;
}

// Cell centres of an n x n grid on each face of [lo, lo + size]^3.
inline Surface cube_faces(int n, double lo, double size) {
  Surface s{Points(3, 6 * n * n), Points(3, 6 * n * n)};
  Eigen::Index at = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          Vec3 p;
          p(axis) = lo + side * size;
          p((axis + 1) % 3) = lo + size * (i + 0.5) / n;
          p((axis + 2) % 3) = lo + size * (j + 0.5) / n;
          s.points.col(at) = p;
          s.normals.col(at++) = (side == 1 ? 1.0 : -1.0) * Vec3::Unit(axis);
        }
  return s;
}

// m^3 grid inside [lo, lo + size]^3, no point on the boundary.
inline Points cube_grid(int m, double lo, double size) {
  Points p(3, m * m * m);
  for (int i = 0; i < m * m * m; ++i)
    p.col(i) =
        Vec3::Constant(lo) + size / (m + 1.0) * Vec3(1 + i / (m * m), 1 + i / m % m, 1 + i % m);
  return p;
}

// Random points of [lo, lo + size]^3; the second half of them on its faces.
inline Points cube_checks(int count, double lo, double size) {
  Points p(3, count);
  for (int i = 0; i < count; ++i) {
    Rng rng(7, Stream::tests, static_cast<std::uint64_t>(i));
    for (int axis = 0; axis < 3; ++axis) p(axis, i) = lo + size * rng.uniform();
    if (i >= count / 2) p(i % 3, i) = lo + size * (i / 3 % 2);
  }
  return p;
}

// Points in the star-shaped body of `surface`, at random fractions of the way from the origin to
// its points, the last a third exactly on the surface.
inline Points star_checks(const Surface& surface) {
  Points p = surface.points;
  for (Eigen::Index i = 0; i < p.cols(); ++i)
    if (i % 3 != 2)
      p.col(i) *= std::cbrt(Rng(7, Stream::tests, static_cast<std::uint64_t>(i)).uniform());
  return p;
}

// A solution known everywhere.
struct Exact {
  std::function<double(const Vec3&)> u;
  std::function<Vec3(const Vec3&)> gradient;
  std::function<double(const Vec3&)> f;  // lap u - lambda^2 u
};

// [V09 7.1]: u = x^2 sin x cos y cos z. lap u = ((2 - 3 x^2) sin x + 4 x cos x) cos y cos z, from
// (x^2 sin x)'' = (2 - x^2) sin x + 4 x cos x and two more -u for y and z: [V09 7.2] is right.
inline Exact thesis_case(double lambda) {
  return {[](const Vec3& p) {
            return p.x() * p.x() * std::sin(p.x()) * std::cos(p.y()) * std::cos(p.z());
          },
          [](const Vec3& p) -> Vec3 {
            const double x = p.x(), w = x * x * std::sin(x);
            return {
                (2.0 * x * std::sin(x) + x * x * std::cos(x)) * std::cos(p.y()) * std::cos(p.z()),
                -w * std::sin(p.y()) * std::cos(p.z()), -w * std::cos(p.y()) * std::sin(p.z())};
          },
          [lambda](const Vec3& p) {
            const double x = p.x();
            return ((2.0 - (3.0 + lambda * lambda) * x * x) * std::sin(x) + 4.0 * x * std::cos(x)) *
                   std::cos(p.y()) * std::cos(p.z());
          }};
}

// exp(lambda d.x) with |d| = 1: homogeneous.
inline Exact plane_wave(double lambda, const Vec3& direction) {
  const Vec3 d = direction.normalized();
  const auto u = [=](const Vec3& p) { return std::exp(lambda * d.dot(p)); };
  return {u, [=](const Vec3& p) -> Vec3 { return lambda * u(p) * d; },
          [](const Vec3&) { return 0.0; }};
}

// exp(-lambda r)/r about a point outside the body: homogeneous, and not in the span of the
// non-singular solutions.
inline Exact point_source(double lambda, const Vec3& at) {
  return {[=](const Vec3& p) {
            const double r = (p - at).norm();
            return std::exp(-lambda * r) / r;
          },
          [=](const Vec3& p) -> Vec3 {
            const double r = (p - at).norm();
            return -std::exp(-lambda * r) * (lambda * r + 1.0) / (r * r * r) * (p - at);
          },
          [](const Vec3&) { return 0.0; }};
}

inline BkmThesisProblem problem(const Surface& surface, const Points& interior, double lambda,
                                double k) {
  return {lambda, k, surface.points, surface.normals, interior};
}

struct Data {
  Eigen::VectorXd f, g;
};

// Source at boundary points, then interior points; Robin data u + k du/dn at the boundary points.
inline Data data_of(const Exact& exact, const BkmThesisProblem& p) {
  const Eigen::Index n = p.boundary_points.cols(), m = p.interior_points.cols();
  Data d{Eigen::VectorXd(n + m), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 x = p.boundary_points.col(i);
    d.f(i) = exact.f(x);
    d.g(i) = exact.u(x) + p.k * exact.gradient(x).dot(p.boundary_normals.col(i));
  }
  for (Eigen::Index i = 0; i < m; ++i) d.f(n + i) = exact.f(p.interior_points.col(i));
  return d;
}

// Largest |u~ - u| over the points.
inline double max_error(const BkmField& field, const Exact& exact, const Points& at) {
  double largest = 0.0;
  const Eigen::VectorXd u = field.values(at);
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    const double e = std::abs(u(i) - exact.u(at.col(i)));
    if (std::isnan(e)) return e;
    largest = std::max(largest, e);
  }
  return largest;
}
inline double max_size(const Exact& exact, const Points& at) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < at.cols(); ++i)
    largest = std::max(largest, std::abs(exact.u(at.col(i))));
  return largest;
}

}  // namespace knotlight::bkm_cases
