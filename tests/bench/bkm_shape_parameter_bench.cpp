// How well dual reciprocity carries a source, against the width of its Gaussians: the measurement
// behind default_shape_parameter(), docs/results/bkm-thesis.md. Time is not the point here; the
// counters are: f_rms and f_max, the rms and largest |f - f~| over the rms and largest |f| at 600
// points that are not knots, at random depths down to 3 transport mean free paths. "noisy" is the
// smooth source with 0.01 of noise at the knots, as photons would leave it.
//
//   bkm_shape_parameter_bench --benchmark_format=csv > shape_parameter.csv
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bkm/knots.h"
#include "bkm/shape_parameter.h"
#include "bkm/thesis_solver.h"
#include "core/shape.h"

namespace knotlight {
namespace {

constexpr double widths[] = {0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0};  // knot spacings
constexpr std::size_t knot_counts[] = {150, 484};
constexpr std::size_t check_points = 600;
constexpr double check_depth = 3.0;  // transport mean free paths
constexpr std::uint64_t seed = 1;

enum class Source { smooth, layered, noisy };
constexpr const char* source_names[] = {"smooth", "layered", "noisy"};
constexpr double noise = 0.01;  // standard deviation of the noisy source's data at the knots

enum class Body { sphere, cube };

// A material, from thin to thick and from hardly to strongly absorbing; the bodies have size 2.
struct Material {
  double sigma_tr;  // 1/length
  double lambda;    // 1/length, at most sqrt(3) sigma_tr
};
constexpr Material materials[] = {{5.0, 0.5}, {5.0, 5.0}, {20.0, 2.0}, {50.0, 20.0}};

struct Case {
  Body body;
  Source source;
  Material material;
  std::size_t knots;
  double width;  // knot spacings

  std::string name() const {
    return fmt::format(
        "{}/{}/sigma_tr:{}/lambda:{}/knots:{}/width:{}", body == Body::sphere ? "sphere" : "cube",
        source_names[static_cast<int>(source)], material.sigma_tr, material.lambda, knots, width);
  }
};

// Unit sphere or cube [-1, 1]^3.
Shape shape_of(Body body) {
  if (body == Body::sphere) return Sphere{};
  return box_mesh(Vec3::Constant(-1.0), Vec3::Constant(1.0));
}
double depth_below_surface(Body body, const Vec3& x) {
  return body == Body::sphere ? 1.0 - x.norm() : 1.0 - x.cwiseAbs().maxCoeff();
}

// Layered: light from +z that dies out with depth, as the reduced incident light does. Smooth and
// noisy: varies over the size of the body.
double source_at(const Case& c, const Vec3& x) {
  if (c.source != Source::layered) return std::sin(2.0 * x.x() + 0.5) * std::cos(x.y()) + x.z();
  const double facing = 0.5 * (1.0 + x.z() / x.norm());
  return facing * std::exp(-c.material.sigma_tr * depth_below_surface(c.body, x));
}

BkmThesisProblem problem_of(const Case& c, const Shape& shape) {
  BkmThesisProblem problem;
  problem.lambda = c.material.lambda;
  problem.k = 2.0 / (3.0 * c.material.sigma_tr);
  const auto surface =
      stratified_surface_points(shape, c.knots, true, seed, Stream::boundary_knots);
  const auto count = static_cast<Eigen::Index>(surface.size());
  problem.boundary_points.resize(3, count);
  problem.boundary_normals.resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    problem.boundary_points.col(i) = surface[static_cast<std::size_t>(i)].position;
    problem.boundary_normals.col(i) = surface[static_cast<std::size_t>(i)].normal;
  }
  problem.interior_points =
      interior_knots(problem.boundary_points, problem.boundary_normals,
                     {1.0 / c.material.sigma_tr, 1.5 / c.material.sigma_tr},
                     [&](const Vec3& x) { return depth_below_surface(c.body, x) > 0.0; })
          .points;
  return problem;
}

void measure(benchmark::State& state, const Case& c) {
  const Shape shape = shape_of(c.body);
  const BkmThesisProblem problem = problem_of(c, shape);
  const Eigen::Index on_boundary = problem.boundary_points.cols();
  Eigen::VectorXd f(on_boundary + problem.interior_points.cols());
  for (Eigen::Index i = 0; i < f.size(); ++i)
    f(i) = source_at(c, i < on_boundary ? Vec3(problem.boundary_points.col(i))
                                        : Vec3(problem.interior_points.col(i - on_boundary)));
  if (c.source == Source::noisy)
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      Rng rng(seed, Stream::photons, static_cast<std::uint64_t>(i));
      f(i) += noise * std::sqrt(12.0) * (rng.uniform() - 0.5);
    }
  BkmThesisOptions options;
  options.c = c.width * mean_knot_spacing(surface_area(shape), c.knots);

  for (auto _ : state) {
    const BkmThesisSolver solver(problem, options);
    const BkmField field = solver.solve(f, Eigen::VectorXd::Zero(on_boundary));
    double squares = 0.0, largest = 0.0, f_squares = 0.0, f_largest = 0.0;
    const auto roots =
        stratified_surface_points(shape, check_points, true, seed, Stream::check_points);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      Rng rng(seed, Stream::tests, i);
      const double depth = std::min(1.0, check_depth / c.material.sigma_tr) * rng.uniform();
      const Vec3 x = roots[i].position - depth * roots[i].normal;
      const double error = field.source(x) - source_at(c, x);
      squares += error * error;
      largest = std::max(largest, std::abs(error));
      f_squares += source_at(c, x) * source_at(c, x);
      f_largest = std::max(f_largest, std::abs(source_at(c, x)));
    }
    state.counters["f_rms"] = std::sqrt(squares / f_squares);
    state.counters["f_max"] = largest / f_largest;
    state.counters["rank"] = solver.particular_rank();
  }
}

const bool registered = [] {
  for (const Body body : {Body::sphere, Body::cube})
    for (const Source source : {Source::smooth, Source::layered, Source::noisy})
      for (const Material& material : materials)
        for (const std::size_t knots : knot_counts)
          for (const double width : widths) {
            const Case c{body, source, material, knots, width};
            benchmark::RegisterBenchmark(c.name().c_str(), measure, c)
                ->Iterations(1)
                ->Unit(benchmark::kMillisecond);
          }
  return true;
}();

}  // namespace
}  // namespace knotlight
