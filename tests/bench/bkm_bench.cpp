// The stages of the boundary knot method at the sizes of the thesis: 100, 484, 961 and 1764
// boundary knots, and three times as many for the particular solution [V09 tab. 7.2, 7.3], on one
// thread and on two. The second argument of a benchmark is the number of threads.
//
//   bkm_bench --benchmark_counters_tabular=true
//
// gemm is a product of matrices of the size of the particular one by the BLAS itself: what the
// machine can do. `of_gemm` of the dense parts: their operations over time as a part of what gemm
// does at the same size on as many threads. Operations count only what every matrix costs, not what
// divide and conquer does on top. One thread is timed by its processor time, so that other work on
// the machine hardly matters; two by the clock.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "bkm/assembly.h"
#include "bkm/lapack.h"
#include "bkm/shape_parameter.h"
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
constexpr RadialFunction waves{RadialKind::nonsingular, 1.0, 1.0, 0, lambda, size_R};

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

// Width by the default rule, in spacings of the knots on the unit sphere.
RadialFunction gaussian(Eigen::Index knots) {
  const double spacing = std::sqrt(4.0 * std::numbers::pi / static_cast<double>(knots));
  return {RadialKind::gaussian, default_shape_parameter() * spacing, 1.0, 1, lambda, size_R};
}

Eigen::MatrixXd particular_matrix(Eigen::Index knots, const Workers& workers) {
  return source_matrix(all_points(problem_with(knots)), gaussian(knots),
                       {DistancePrecision::double_precision, workers});
}

double clock_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double seconds(int threads, const std::function<void()>& work) {
  const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const double start = clock_seconds(clock);
  work();
  return clock_seconds(clock) - start;
}

// Operations per second of a product of n x n matrices: the best of three, measured once.
double gemm_rate(Eigen::Index size, int threads) {
  static std::map<std::pair<Eigen::Index, int>, double> known;
  double& rate = known[{size, threads}];
  if (rate > 0.0) return rate;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(size, size);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(size, size);
  Eigen::MatrixXd c(size, size);
  const int n = static_cast<int>(size);
  const double one = 1.0, zero = 0.0;
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(threads);
  for (int i = 0; i < 3; ++i) {
    const double t = seconds(threads, [&] {
      dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &zero, c.data(), &n);
    });
    rate = std::max(rate, 2.0 * std::pow(static_cast<double>(n), 3.0) / t);
  }
  return rate;
}

benchmark::Counter per_second(double amount) {
  return {amount, benchmark::Counter::kIsIterationInvariantRate};
}

// Runs `work` and reports its operations per second, also as a part of gemm's.
void dense_part(benchmark::State& state, Eigen::Index n, int threads, double operations,
                const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const double t = seconds(threads, work);
    best = std::min(best, t);
    state.SetIterationTime(t);
  }
  state.counters["GFlop/s"] = 1e-9 * operations / best;
  state.counters["of_gemm"] = operations / best / gemm_rate(n, threads);
}

void gemm(benchmark::State& state) {
  const Eigen::Index n = 3 * state.range(0);
  const int threads = static_cast<int>(state.range(1));
  for (auto _ : state) state.SetIterationTime(2.0 * std::pow(n, 3.0) / gemm_rate(n, threads));
  state.counters["GFlop/s"] = 1e-9 * gemm_rate(n, threads);
}

void assembly(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const AssemblyOptions options{DistancePrecision::double_precision,
                                Workers(static_cast<int>(state.range(1)))};
  const Points all = all_points(problem_with(knots)), surface = sphere_points(knots, 1.0);
  const RadialFunction w = gaussian(knots);
  for (auto _ : state) {
    benchmark::DoNotOptimize(source_matrix(all, w, options).data());
    benchmark::DoNotOptimize(robin_matrix(surface, surface, surface, k, waves, options).data());
  }
  state.counters["entries/s"] = per_second(10.0 * std::pow(static_cast<double>(knots), 2.0));
}

// By eigenvalues, n x n: 4/3 n^3 to tridiagonal form, half of it bound by memory, and 2 n^3 back.
// By SVD: 8/3 n^3 to bidiagonal form, half of it bound by memory, and 2 n^3 back for each factor.
double full_operations(double n, bool symmetric) {
  return (symmetric ? 10.0 / 3.0 : 20.0 / 3.0) * n * n * n;
}

// What the range finder does if it keeps q of n columns: two products with the matrix, 2 n^2 q
// each, orthogonalisation 6 n q^2 (three times against the range so far); then q^T a q and the way
// back, 2 n q^2 each. Without symmetry a QR decomposition of n x q, 4 n q^2, and one more product.
double compressed_operations(double n, double q, bool symmetric) {
  return 4.0 * n * n * q + (symmetric ? 10.0 : 14.0) * n * q * q + full_operations(q, symmetric);
}

void particular(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(1));
  const Eigen::MatrixXd phi = particular_matrix(state.range(0), Workers(2));
  const double cut = pinv_cut(phi.rows(), phi.cols());
  SpectralFactors f = spectral_factors(phi, cut, Workers(2));
  const double n = static_cast<double>(phi.rows()), q = static_cast<double>(f.s.size());
  dense_part(state, phi.rows(), threads,
             f.complete ? full_operations(n, n >= 512) : compressed_operations(n, q, true),
             [&] { f = spectral_factors(phi, cut, Workers(threads)); });
  state.counters["found"] = q;
  state.counters["rank"] = static_cast<double>((f.s.array() > cut * f.s(0)).count());
}

void homogeneous(benchmark::State& state) {
  const int threads = static_cast<int>(state.range(1));
  const Points surface = sphere_points(state.range(0), 1.0);
  const Eigen::MatrixXd robin = robin_matrix(surface, surface, surface, k, waves);
  const double cut = pinv_cut(robin.rows(), robin.cols());
  SpectralFactors f = spectral_factors(robin, cut, Workers(2));
  const double n = static_cast<double>(robin.rows()), q = static_cast<double>(f.s.size());
  dense_part(state, robin.rows(), threads,
             f.complete ? full_operations(n, false) : compressed_operations(n, q, false),
             [&] { f = spectral_factors(robin, cut, Workers(threads)); });
  state.counters["found"] = q;
  state.counters["rank"] = static_cast<double>((f.s.array() > cut * f.s(0)).count());
}

// All that comes before the picture: assembly, two decompositions, one solve.
void whole_solve(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const BkmThesisProblem p = problem_with(knots);
  BkmThesisOptions options;
  options.c = gaussian(knots).c;
  options.workers = Workers(static_cast<int>(state.range(1)));
  for (auto _ : state) {
    const BkmThesisSolver solver(p, options);
    benchmark::DoNotOptimize(
        solver.solve(Eigen::VectorXd::Ones(3 * knots), Eigen::VectorXd::Ones(knots))
            .value(Vec3::Zero()));
  }
}

// The candidates for the particular matrix, one thread. LU 2/3 n^3, pivoted QR 4/3 n^3.
enum class Candidate { lu, qr, eigenvalues, svd };
void candidate(benchmark::State& state, Candidate which, double operations) {
  const Eigen::MatrixXd phi = particular_matrix(state.range(0), Workers(2));
  const double n = static_cast<double>(phi.rows());
  dense_part(state, phi.rows(), 1, operations * n * n * n, [&] {
    Eigen::MatrixXd a = phi;
    Eigen::VectorXd d;
    if (which == Candidate::lu) benchmark::DoNotOptimize(lapack::lu(std::move(a)).rows.data());
    if (which == Candidate::qr)
      benchmark::DoNotOptimize(lapack::pivoted_qr(std::move(a)).tau.data());
    if (which == Candidate::eigenvalues) lapack::symmetric_eigen(a, d);
    if (which == Candidate::svd) benchmark::DoNotOptimize(lapack::svd(a).s.data());
  });
}

// Values of a field of range(0) boundary knots, 4 kernels a knot; one thread.
void evaluation(benchmark::State& state) {
  const Eigen::Index knots = state.range(0);
  const BkmField field({point_columns(all_points(problem_with(knots))), gaussian(knots),
                        point_columns(sphere_points(knots, 1.0)), waves},
                       Eigen::VectorXd::Random(3 * knots), Eigen::VectorXd::Random(knots));
  const Points at = sphere_points(1000, 0.95);
  for (auto _ : state) benchmark::DoNotOptimize(field.values(at).data());
  state.counters["points/s"] = per_second(1000.0);
  state.counters["kernels/s"] = per_second(4000.0 * static_cast<double>(knots));
}

void thesis_sizes(benchmark::internal::Benchmark* b) {
  b->ArgsProduct({{100, 484, 961, 1764}, {1, 2}})->Unit(benchmark::kMillisecond);
}
void once_timed(benchmark::internal::Benchmark* b) {
  thesis_sizes(b);
  b->UseManualTime()->Iterations(2);
}
void middle_size(benchmark::internal::Benchmark* b) {
  b->Arg(961)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(1);
}

BENCHMARK(gemm)->Apply(once_timed);
BENCHMARK(assembly)->Apply(thesis_sizes)->UseRealTime();
BENCHMARK(particular)->Apply(once_timed);
BENCHMARK(homogeneous)->Apply(once_timed);
BENCHMARK(whole_solve)->Apply(thesis_sizes)->UseRealTime();
BENCHMARK_CAPTURE(candidate, lu, Candidate::lu, 2.0 / 3.0)->Apply(middle_size);
BENCHMARK_CAPTURE(candidate, qr, Candidate::qr, 4.0 / 3.0)->Apply(middle_size);
BENCHMARK_CAPTURE(candidate, eigenvalues, Candidate::eigenvalues, 10.0 / 3.0)->Apply(middle_size);
BENCHMARK_CAPTURE(candidate, svd, Candidate::svd, 20.0 / 3.0)->Apply(middle_size);
BENCHMARK(evaluation)->Arg(100)->Arg(484)->Arg(961)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace knotlight
