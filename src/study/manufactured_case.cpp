#include "study/manufactured_case.h"

#include <cmath>

#include "bkm/assembly.h"
#include "bkm/dense_solver.h"
#include "bkm/global_solver.h"
#include "core/not_finite.h"
#include "core/rng.h"
#include "study/lit_body.h"

namespace knotlight {
namespace {

constexpr double known_side = 2.0;
constexpr Eigen::Index known_checks = 400;
constexpr std::uint64_t check_seed = 7;  // fixed, so that errors of all settings can be compared

constexpr double better_width = 2.0;  // as the cube; 1 to 3 are as good within a factor of three
constexpr double source_cube = 3.0;   // size of the cube of sources over that of the body
constexpr int more_rows = 4;          // least squares: knots per edge beyond those of the sources
// Far below any pivot of these matrices but those that are rounding.
constexpr double pivot_cut = 1e-13;

Points rounded(const Points& x, DistancePrecision precision) {
  if (precision == DistancePrecision::double_precision) return x;
  return x.cast<float>().cast<double>();
}

}  // namespace

double manufactured_lambda() {
  return std::sqrt(3.0);
}

double manufactured_u(const Vec3& p) {
  return p.x() * p.x() * std::sin(p.x()) * std::cos(p.y()) * std::cos(p.z());
}

Vec3 manufactured_gradient(const Vec3& p) {
  const double x = p.x(), w = x * x * std::sin(x);
  const double slope = 2.0 * x * std::sin(x) + x * x * std::cos(x);
  return {slope * std::cos(p.y()) * std::cos(p.z()), -w * std::sin(p.y()) * std::cos(p.z()),
          -w * std::cos(p.y()) * std::sin(p.z())};
}

// (x^2 sin x)'' = (2 - x^2) sin x + 4 x cos x, and -u twice more for y and z [V09 7.2].
double manufactured_source(const Vec3& p) {
  const double x = p.x(), lambda = manufactured_lambda();
  return ((2.0 - (3.0 + lambda * lambda) * x * x) * std::sin(x) + 4.0 * x * std::cos(x)) *
         std::cos(p.y()) * std::cos(p.z());
}

Eigen::VectorXd manufactured_data(const SurfaceSamples& at) {
  Eigen::VectorXd g(at.positions.cols());
  for (Eigen::Index i = 0; i < g.size(); ++i) {
    const Vec3 x = at.positions.col(i);
    g[i] = manufactured_u(x) + manufactured_k * manufactured_gradient(x).dot(at.normals.col(i));
  }
  return g;
}

ManufacturedProblem manufactured_problem(int n, int m) {
  const SurfaceSamples faces = cube_face_knots(n);
  Points inside(3, m * m * m);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int l = 0; l < m; ++l)
        inside.col((i * m + j) * m + l) = known_side / (m + 1.0) * Vec3(1 + i, 1 + j, 1 + l);
  ManufacturedProblem p{
      {manufactured_lambda(), manufactured_k, faces.positions, faces.normals, inside},
      {},
      manufactured_data(faces)};
  const Points all = all_points(p.problem);
  p.f.resize(all.cols());
  for (Eigen::Index i = 0; i < p.f.size(); ++i) p.f[i] = manufactured_source(all.col(i));
  return p;
}

Eigen::VectorXd manufactured_better(const ManufacturedProblem& p, int n,
                                    DistancePrecision precision) {
  const double lambda = p.problem.lambda;
  const Points centers = all_points(p.problem);
  BkmThesisOptions options;
  options.c = better_width;
  BkmBasis basis;
  basis.centers = point_columns(centers);
  basis.particular = radial_function(options, lambda, 1.0);
  basis.knots = PointColumns(0, 3);
  basis.precision = precision;
  const Workers alone(1);
  const DenseSolver source(source_matrix(centers, basis.particular, {precision, alone}),
                           {DenseMethod::tikhonov_gcv, -1.0, alone});
  const BkmField particular(basis, source.solve(p.f), {});

  const SurfaceSamples rows = cube_face_knots(n + more_rows);
  Eigen::VectorXd rest = manufactured_data(rows);
  for (Eigen::Index i = 0; i < rest.size(); ++i)
    rest[i] -= particular.robin(rows.positions.col(i), rows.normals.col(i), manufactured_k);
  const Vec3 middle = Vec3::Constant(0.5 * known_side);
  const Points sources =
      (source_cube * (p.problem.boundary_points.colwise() - middle)).colwise() + middle;
  const GlobalBkmSolver solver({lambda, manufactured_k, rounded(sources, precision),
                                rounded(rows.positions, precision), rows.normals},
                               GlobalBasis::exterior_sources, pivot_cut, alone);
  const GlobalField homogeneous = solver.solve(rest);

  const Points at = manufactured_checks();
  Eigen::VectorXd u = particular.values(at);
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] += homogeneous.value(rounded(at.col(i), precision).col(0));
  return u;
}

Points manufactured_checks() {
  Points p(3, known_checks);
  for (Eigen::Index i = 0; i < known_checks; ++i) {
    Rng rng(check_seed, Stream::check_points, static_cast<std::uint64_t>(i));
    for (int axis = 0; axis < 3; ++axis) p(axis, i) = known_side * rng.uniform();
    if (i >= known_checks / 2) p(i % 3, i) = known_side * static_cast<double>(i / 3 % 2);
  }
  return p;
}

double manufactured_error(const Eigen::VectorXd& values) {
  const Points at = manufactured_checks();
  if (values.hasNaN()) return nan;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < at.cols(); ++i)
    largest = std::max(largest, std::abs(values[i] - manufactured_u(at.col(i))));
  return largest;
}

}  // namespace knotlight
