// The stages of the boundary knot method at the sizes of the thesis: 100, 484 and 961 boundary
// knots, and three times as many for the particular solution [V09 tab. 7.2, 7.3]. One thread.
//
//   bkm_bench --benchmark_counters_tabular=true
//
// GFlop/s of the decomposition count what every n x n matrix costs: 8 n^3 / 3 to reduce it to
// bidiagonal form, half of that in matrix-vector products that wait for memory, and 2 n^3 to carry
// each of the two factors back. Divide and conquer comes on top, less for matrices whose singular
// values crowd. gemm, a product of matrices of the same size, shows what the processor can do.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "bkm/assembly.h"
#include "bkm/kernel_batch.h"
#include "bkm/thesis_solver.h"

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
            const double*, const int*, const double*, const int*, const double*, double*,
            const int*);
void openblas_set_num_threads(int) __attribute__((weak));
}

namespace knotlight {
namespace {

constexpr double lambda = 2.74, k = 0.133;  // five mean free paths, reduced albedo 0.9
constexpr double size_R = 2.0;

Points sphere_points(Eigen::Index count, double radius) {
  Points p(3, count);
  const double n = static_cast<double>(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at = static_cast<double>(i);
    const double z = 1.0 - (2.0 * at + 1.0) / n;
    const double phi = 2.0 * std::numbers::pi * at / std::numbers::phi;
    const double rho = std::sqrt(1.0 - z * z);
    p.col(i) = radius * Vec3(rho * std::cos(phi), rho * std::sin(phi), z);
  }
  return p;
}

BkmThesisProblem problem_with(Eigen::Index knots) {
  const Points surface = sphere_points(knots, 1.0);
  Points inner(3, 2 * knots);
  inner << sphere_points(knots, 0.8), sphere_points(knots, 0.7);
  return {lambda, k, surface, surface, inner};
}

Points all_points(Eigen::Index knots) {
  const BkmThesisProblem p = problem_with(knots);
  Points all(3, 3 * knots);
  all << p.boundary_points, p.interior_points;
  return all;
}

// Width by the default rule, 8 spacings of the knots on the unit sphere.
double width(Eigen::Index knots) {
  return 8.0 * std::sqrt(4.0 * std::numbers::pi / static_cast<double>(knots));
}

benchmark::Counter per_second(double amount) {
  return {amount, benchmark::Counter::kIsIterationInvariantRate};
}

void gemm(benchmark::State& state) {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  const int n = static_cast<int>(state.range(0));
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n), b = Eigen::MatrixXd::Random(n, n);
  Eigen::MatrixXd c(n, n);
  const double one = 1.0, zero = 0.0;
  for (auto _ : state)
    dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
  state.counters["GFlop/s"] = per_second(2e-9 * std::pow(n, 3.0));
}

// The larger of the two matrices, range(0) = boundary knots.
void decomposition(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const Eigen::MatrixXd phi = source_matrix(all_points(knots), width(knots), lambda);
  int rank = 0;
  for (auto _ : state) rank = PseudoInverse(phi, -1.0).rank();
  const double n = 3.0 * static_cast<double>(knots);
  state.counters["GFlop/s"] = per_second((8.0 / 3.0 + 4.0) * 1e-9 * n * n * n);
  state.counters["rank"] = rank;
}

void assembly(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const Points all = all_points(knots), surface = sphere_points(knots, 1.0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(source_matrix(all, width(knots), lambda).data());
    benchmark::DoNotOptimize(robin_matrix(surface, surface, lambda, k, size_R).data());
  }
  state.counters["entries/s"] = per_second(10.0 * std::pow(static_cast<double>(knots), 2.0));
}

// All that comes before the picture: assembly, two decompositions, one solve.
void whole_solve(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const BkmThesisProblem p = problem_with(knots);
  for (auto _ : state) {
    const BkmThesisSolver solver(p, {width(knots), -1.0});
    benchmark::DoNotOptimize(
        solver.solve(Eigen::VectorXd::Ones(3 * knots), Eigen::VectorXd::Ones(knots))
            .value(Vec3::Zero()));
  }
}

// Values of a field of range(0) boundary knots, 4 kernels a knot.
void evaluation(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const BkmField field({point_columns(all_points(knots)), point_columns(sphere_points(knots, 1.0)),
                        lambda, width(knots), size_R},
                       Eigen::VectorXd::Random(3 * knots), Eigen::VectorXd::Random(knots));
  const Points at = sphere_points(1000, 0.95);
  for (auto _ : state) benchmark::DoNotOptimize(field.values(at).data());
  state.counters["points/s"] = per_second(1000.0);
  state.counters["kernels/s"] = per_second(4000.0 * static_cast<double>(knots));
}

BENCHMARK(gemm)->Arg(300)->Arg(1452)->Arg(2883)->Unit(benchmark::kMillisecond);
BENCHMARK(assembly)->Arg(100)->Arg(484)->Arg(961)->Unit(benchmark::kMillisecond);
BENCHMARK(decomposition)->Arg(100)->Arg(484)->Arg(961)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_solve)->Arg(100)->Arg(484)->Arg(961)->Unit(benchmark::kMillisecond);
BENCHMARK(evaluation)->Arg(100)->Arg(484)->Arg(961)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace knotlight
