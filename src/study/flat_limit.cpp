// [V09 ch. 8.2]: more advanced methods for ill-conditioned matrices, of which it names Contour-Pade
// [FW04]. Its successors and plain higher precision on the boundary matrix.
#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "bkm/dense_solver.h"
#include "bkm/global_solver.h"
#include "core/clock.h"
#include "core/not_finite.h"
#include "core/rng.h"
#include "study/experiments.h"
#include "study/flat_basis.h"
#include "study/knot_matrix.h"
#include "study/lit_ball.h"
#include "study/lit_body.h"
#include "study/rational_limit.h"
#include "study/singular_values.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double robin_k = 2.0 / 15.0;  // sigma_tr = 5: bodies of ten mean free paths
constexpr double usual_distance = 0.2;  // from the surface to a lamp: one of them
constexpr int wave_degree = 20;         // of the addition theorem, beyond that of any set of knots
// Of the matrices that the rational function is fitted to. Larger circles give better ones, but
// take in more poles; measured on the ball, this is where the sum of both errors is least.
constexpr double fit_condition = 1e15;
constexpr double smallest_circle = 2.0, largest_circle = 8.0;  // of lambda; 1/length
constexpr double circle_step = 1.2;
constexpr int half_circle_points = 32;

struct Body {
  std::string name;
  SurfaceSamples knots, checks;
  Points outside;  // sources
  Vec3 lit;        // the surface point nearest to the lamp; its normal is its direction
  bool ball;
};

Body ball(int knots, std::uint64_t seed) {
  constexpr double source_sphere = 1.5;
  const SurfaceSamples on = fibonacci_knots(knots);
  const Vec3 lit = Vec3(1.0, 2.0, 2.0) / 3.0;
  return {"ball", on, ball_knots(20, true, seed), source_sphere * on.positions, lit, true};
}

constexpr double ring = 0.7;

SurfacePoint on_torus(double u, double v, double tube) {
  const Vec3 out(std::cos(u), std::sin(u), 0.0);
  const Vec3 n = std::cos(v) * out + std::sin(v) * Vec3::UnitZ();
  return {ring * out + tube * n, n};
}

// In the unit ball, and not star-shaped: no ray from its middle meets it once.
Body torus(int count, std::uint64_t seed) {
  constexpr double tube = 0.3, source_tube = 0.5;
  constexpr std::uint64_t check_count = 400;
  std::vector<SurfacePoint> knots, outside, checks;
  for (int i = 0; i < count; ++i) {
    // Spread evenly, in no rings: those hold only as many waves as they have points.
    const double turns = 0.5 + i / std::numbers::phi;
    const double u = 2.0 * pi * (turns - std::floor(turns));
    // Below v lies a share (v + tube / ring sin v) / 2 pi of the area.
    const double share = 2.0 * pi * (i + 0.5) / count;
    double v = share;
    for (int step = 0; step < 20; ++step)  // a contraction by tube / ring
      v = share - tube / ring * std::sin(v);
    knots.push_back(on_torus(u, v, tube));
    outside.push_back(on_torus(u, v, source_tube));
  }
  for (std::uint64_t i = 0; i < check_count; ++i) {
    Rng rng(seed, Stream::check_points, i);
    const double u = 2.0 * pi * rng.uniform(), v = 2.0 * pi * rng.uniform();
    checks.push_back(on_torus(u, v, tube));
  }
  return {"torus",       columns(knots), columns(checks), columns(outside).positions,
          Vec3::UnitX(), false};
}

struct Data {
  Eigen::MatrixXd robin;  // at the knots, a column for each problem
  Eigen::MatrixXd truth;  // at the checks
};

// The wave exp(lambda d.x), and with k its Robin values.
Eigen::VectorXd smooth_wave(const SurfaceSamples& at, double lambda, double k) {
  const Vec3 d = Vec3(2.0, -1.0, 2.0) / 3.0;
  return ((lambda * (d.transpose() * at.positions).array()).exp() *
          (1.0 + k * lambda * (d.transpose() * at.normals).array()))
      .transpose();
}

// The same of the field exp(-lambda r)/r of a lamp outside.
Eigen::VectorXd spot(const SurfaceSamples& at, const Vec3& lit, double distance, double lambda,
                     double k) {
  const Points d = at.positions.colwise() - (1.0 + distance) * lit;
  const Eigen::ArrayXd r = d.colwise().norm().transpose();
  const Eigen::ArrayXd along = d.cwiseProduct(at.normals).colwise().sum().transpose();
  return (-lambda * (r - distance)).exp() / r * (1.0 - k * (lambda + 1.0 / r) * along / r);
}

// Columns: the wave; a lamp outside; on the ball, the light of a distant lamp.
Data usual_data(const Body& body, double lambda) {
  const SurfaceSamples& knots = body.knots;
  const SurfaceSamples& checks = body.checks;
  const Eigen::Index count = body.ball ? 3 : 2;
  Data data{Eigen::MatrixXd(knots.positions.cols(), count),
            Eigen::MatrixXd(checks.positions.cols(), count)};
  data.robin.col(0) = smooth_wave(knots, lambda, robin_k);
  data.truth.col(0) = smooth_wave(checks, lambda, 0.0);
  data.robin.col(1) = spot(knots, body.lit, usual_distance, lambda, robin_k);
  data.truth.col(1) = spot(checks, body.lit, usual_distance, lambda, 0.0);
  if (body.ball) {
    data.robin.col(2) = (knots.positions.transpose() * body.lit).unaryExpr(&lit_ball_data);
    data.truth.col(2) = lit_ball_field(checks.positions.transpose() * body.lit, lambda, robin_k);
  }
  return data;
}

Data spots(const Body& body, double lambda, const std::vector<double>& distances) {
  Data data{Eigen::MatrixXd(body.knots.positions.cols(), distances.size()),
            Eigen::MatrixXd(body.checks.positions.cols(), distances.size())};
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    data.robin.col(column) = spot(body.knots, body.lit, distances[i], lambda, robin_k);
    data.truth.col(column) = spot(body.checks, body.lit, distances[i], lambda, 0.0);
  }
  return data;
}

struct Answer {
  Eigen::MatrixXd u;  // at the checks, a column for each problem
  double condition = nan, rank = nan;
};

Answer by_dense_solver(const Body& body, double lambda, const Eigen::MatrixXd& g,
                       DenseMethod method) {
  const double s = lambda * lambda;
  const DenseSolver solver(
      knot_matrix(body.knots.positions, &body.knots.normals, body.knots.positions, s, robin_k),
      {method, -1.0, Workers(1)});
  const Eigen::MatrixXd beta = solver.solve_columns(g);
  return {knot_matrix(body.checks.positions, nullptr, body.knots.positions, s, 0.0) * beta,
          solver.condition(), static_cast<double>(solver.rank())};
}

Answer by_more_digits(const Body& body, double lambda, const Eigen::MatrixXd& g) {
  using Matrix = MatrixOf<DoubleDouble>;
  // Of the largest pivot: what is below it is rounding.
  const DoubleDouble cut =
      Eigen::NumTraits<DoubleDouble>::epsilon() * DoubleDouble(static_cast<double>(g.rows()));
  const DoubleDouble s = DoubleDouble(lambda) * DoubleDouble(lambda);
  const Eigen::ColPivHouseholderQR<Matrix> qr(
      knot_matrix(body.knots.positions, &body.knots.normals, body.knots.positions, s, robin_k));
  const auto pivot = [&](Eigen::Index i) { return abs(qr.matrixQR()(i, i)); };
  const Eigen::Index n = g.rows();
  Eigen::Index rank = 0;
  while (rank < n && pivot(rank) > cut * pivot(0)) ++rank;
  const Matrix rotated = qr.householderQ().adjoint() * g.cast<DoubleDouble>();
  Matrix beta = Matrix::Constant(n, g.cols(), DoubleDouble(0.0));
  beta.topRows(rank) = qr.matrixQR()
                           .topLeftCorner(rank, rank)
                           .triangularView<Eigen::Upper>()
                           .solve(rotated.topRows(rank));
  const Matrix u = knot_matrix(body.checks.positions, nullptr, body.knots.positions, s, 0.0) *
                   (qr.colsPermutation() * beta);
  return {u.unaryExpr([](const DoubleDouble& x) { return static_cast<double>(x); }),
          static_cast<double>(pivot(0) / pivot(n - 1)), static_cast<double>(rank)};
}

Answer by_addition_theorem(const Body& body, double lambda, const Eigen::MatrixXd& g) {
  const FlatBasis basis(body.knots.positions, lambda, 1.0, wave_degree);
  const DenseSolver solver(basis.matrix(body.knots.positions, &body.knots.normals, robin_k),
                           {DenseMethod::svd, -1.0, Workers(1)});
  return {basis.matrix(body.checks.positions, nullptr, 0.0) * solver.solve_columns(g),
          solver.condition(), static_cast<double>(solver.rank())};
}

// The limit itself of all lambda: no more waves than half of the knots, by least squares.
Answer by_waves(const Body& body, double lambda, const Eigen::MatrixXd& g) {
  const auto knots = static_cast<double>(body.knots.positions.cols());
  const SphericalWaves waves(static_cast<int>(std::sqrt(0.5 * knots)) - 1, lambda, 1.0);
  const auto matrix = [&](const SurfaceSamples& at, double k) {
    Eigen::MatrixXd m(at.positions.cols(), waves.size());
    Eigen::VectorXd row(waves.size());
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
      waves.robin(at.positions.col(i), at.normals.col(i), k, row);
      m.row(i) = row.transpose();
    }
    return m;
  };
  const DenseSolver solver(matrix(body.knots, robin_k), {DenseMethod::svd, -1.0, Workers(1)});
  return {matrix(body.checks, 0.0) * solver.solve_columns(g), solver.condition(),
          static_cast<double>(solver.rank())};
}

// As a function of lambda^2, of which the kernels are power series.
Answer by_rational_function(const Body& body, double lambda, const Eigen::MatrixXd& g) {
  const Points& knots = body.knots.positions;
  const Eigen::Index checks = body.checks.positions.cols();
  if (lambda * circle_step > largest_circle)
    return {Eigen::MatrixXd::Constant(checks, g.cols(), nan)};
  double radius = std::max(smallest_circle, circle_step * lambda), condition = nan;
  for (;; radius *= circle_step) {
    const Eigen::MatrixXd a =
        knot_matrix(knots, &body.knots.normals, knots, radius * radius, robin_k);
    condition = 1.0 / Eigen::PartialPivLU<Eigen::MatrixXd>(a).rcond();
    if (condition < fit_condition || radius * circle_step > largest_circle) break;
  }
  const Eigen::VectorXcd circle = half_circle(half_circle_points);
  Eigen::MatrixXcd on_circle(checks * g.cols(), circle.size());
  for (Eigen::Index i = 0; i < circle.size(); ++i) {
    const std::complex<double> s = radius * radius * circle[i];
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(
        knot_matrix(knots, &body.knots.normals, knots, s, robin_k));
    on_circle.col(i) = (knot_matrix(body.checks.positions, nullptr, knots, s, 0.0) *
                        lu.solve(g.cast<std::complex<double>>()))
                           .reshaped();
  }
  const double z = lambda * lambda / (radius * radius);
  Answer answer{Eigen::MatrixXd(checks, g.cols()), condition, nan};
  for (Eigen::Index d = 0; d < g.cols(); ++d)
    answer.u.col(d) = rational_limit(on_circle.middleRows(d * checks, checks), z);
  return answer;
}

Answer by_sources_outside(const Body& body, double lambda, const Eigen::MatrixXd& g) {
  constexpr double cut = 1e-14;
  const GlobalBkmSolver solver(
      {lambda, robin_k, body.outside, body.knots.positions, body.knots.normals},
      GlobalBasis::exterior_sources, cut, Workers(1));
  Answer answer{Eigen::MatrixXd(body.checks.positions.cols(), g.cols()), solver.condition(),
                static_cast<double>(solver.rank())};
  for (Eigen::Index d = 0; d < g.cols(); ++d) {
    const GlobalField field = solver.solve(g.col(d));
    for (Eigen::Index i = 0; i < answer.u.rows(); ++i)
      answer.u(i, d) = field.value(body.checks.positions.col(i));
  }
  return answer;
}

const char* const why_flat =
    "All of these do give back what rounding took. On a ball with lambda R = 0.02 the "
    "pseudo-inverse stops at 2e-7; with 31 digits, by the addition theorem or by the rational "
    "function the same functions give 1e-13 and better, and of a condition of 1e33 or more the "
    "addition theorem leaves 230. But light is not smooth. Twice the digits buy twice the degree, "
    "rank 25 becomes 100 at lambda R = 0.27, and no more: 324 knots do no better than 225, and a "
    "lamp 0.2 radii away is still 6 % wrong. The full rank (RBF-QR) is one wave per knot, which "
    "swings between them: 26 %, and with 324 knots 400 %. Half as many waves by least squares are "
    "better, and take 2 ms. The rational function has a trouble of its own here. Unlike an "
    "interpolant, the solution has poles in lambda² at the body's own eigenvalues; circles on "
    "which the matrix is good hold many of them, and fitting takes forty to eighty times as long "
    "as the pseudo-inverse; on the torus no circle has a good matrix, and it fails. The addition "
    "theorem works there too for smooth data (1e-9 and better), if the knots lie in no rings. More "
    "digits always work, at ten to twenty times the time, up to the same limits. At lambda R = 27 "
    "nothing is flat, and nothing is gained. So the inversion is not what is wrong. Sources "
    "outside, or half as many waves as knots, have conditions below 300, take 2 to 3 ms, and for "
    "light in the first table, up to lambda R = 2.74, errors of the best of them no larger than "
    "those of any exact inversion, but for the torus at 2.74 (12 % and 11 %). What the sources "
    "lack, "
    "digits of smooth fields, light does not ask for. And what is sharp is better taken out first, "
    "by the photons' images, so that the rest needs few waves: 25 in each patch.";

struct Way {
  std::string name, short_name;
  std::function<Answer(const Body&, double, const Eigen::MatrixXd&)> solve;
};

const std::vector<Way>& ways() {
  static const std::vector<Way> all{
      {"after its method: pseudo-inverse", "pseudo-inverse",
       [](const Body& body, double lambda, const Eigen::MatrixXd& g) {
         return by_dense_solver(body, lambda, g, DenseMethod::svd);
       }},
      {"after its method: LU", "LU",
       [](const Body& body, double lambda, const Eigen::MatrixXd& g) {
         return by_dense_solver(body, lambda, g, DenseMethod::lu);
       }},
      {"its matrix with 31 digits", "31 digits", by_more_digits},
      {"its functions by the addition theorem (RBF-QR)", "RBF-QR", by_addition_theorem},
      {"its limit by rational functions (RBF-RA)", "RBF-RA", by_rational_function},
      {"spherical waves, half as many as knots", "waves", by_waves},
      {"as it should be: sources outside", "outside", by_sources_outside}};
  return all;
}

std::vector<Cell> error_cells(const Answer& answer, const Data& data) {
  std::vector<Cell> cells;
  for (Eigen::Index i = 0; i < data.truth.cols(); ++i)
    cells.emplace_back((answer.u.col(i) - data.truth.col(i)).norm() / data.truth.col(i).norm());
  return cells;
}

StudyTable spot_table(bool quick, std::uint64_t seed, StudyChart& chart) {
  constexpr double lambda = 0.27;
  const std::vector<double> distances{0.8, 0.4, 0.2, 0.1};
  StudyTable table{"spots",
                   "Sharper light: the ball with lambda R = 0.27 and a lamp outside at distances "
                   "of 0.8 to 0.1 radii from the surface; relative L2 errors",
                   {"way", "knots", "rank", "0.8", "0.4", "0.2", "0.1"},
                   {}};
  for (const int knots : quick ? std::vector{100} : std::vector{100, 225, 324}) {
    const Body body = ball(knots, seed);
    const Data data = spots(body, lambda, distances);
    for (const Way& way : ways()) {
      const Answer answer = way.solve(body, lambda, data.robin);
      std::vector<Cell> row{way.name, static_cast<double>(knots), answer.rank};
      ChartSeries series{way.short_name, distances, {}, {}};
      for (const Cell& cell : error_cells(answer, data)) {
        row.push_back(cell);
        series.y.push_back(std::get<double>(cell));
      }
      table.rows.push_back(std::move(row));
      if (knots == (quick ? 100 : 225)) chart.chart.series.push_back(std::move(series));
    }
  }
  return table;
}

StudyFindings redo_flat_limit(StudyBench& bench) {
  const bool quick = bench.options.quick;
  const std::uint64_t seed = bench.run.options.seed;
  const std::vector<Body> bodies{ball(quick ? 100 : 225, seed), torus(quick ? 96 : 240, seed)};
  StudyTable table{
      "",
      fmt::format("Relative L2 errors at 400 points that are no knots. {} knots on a ball of "
                  "radius 1, {} on a torus of radii 0.7 and 0.3; k = 0.13. Smooth: the field is "
                  "exp(lambda d.x); spot: that of a lamp 0.2 outside; lit: light of a distant lamp "
                  "as boundary data, in closed form. The logarithm of the condition is how many "
                  "digits of the weights are lost",
                  bodies[0].knots.positions.cols(), bodies[1].knots.positions.cols()),
      {"way", "body", "lambda R", "condition", "rank", "error, smooth", "error, spot", "error, lit",
       "seconds"},
      {}};
  StudyChart smooth{"",
                    {"Smooth data on a ball", "lambda R", "relative error", true, true, {}},
                    "What the arithmetic loses: nothing but digits of a smooth field."};
  StudyChart sharp{"spots",
                   {"Lamps outside a ball, lambda R = 0.27",
                    "distance of the lamp from the surface, radii",
                    "relative error",
                    true,
                    true,
                    {}},
                   "What no arithmetic can give back: sharp light needs as many waves as it has."};
  for (const Way& way : ways()) smooth.chart.series.push_back({way.short_name, {}, {}, {}});
  for (const Body& body : bodies)
    for (const double lambda : quick ? std::vector{0.27} : std::vector{0.02, 0.27, 2.74, 27.4}) {
      const Data data = usual_data(body, lambda);
      for (std::size_t w = 0; w < ways().size(); ++w) {
        const double start = cpu_seconds();
        const Answer answer = ways()[w].solve(body, lambda, data.robin);
        const double seconds = cpu_seconds() - start;
        const std::vector<Cell> e = error_cells(answer, data);
        table.rows.push_back({ways()[w].name, body.name, lambda, answer.condition, answer.rank,
                              e[0], e[1], body.ball ? e[2] : Cell(nan), seconds});
        if (!body.ball) continue;
        smooth.chart.series[w].x.push_back(lambda);
        smooth.chart.series[w].y.push_back(std::get<double>(e[0]));
      }
    }
  StudyTable sharper = spot_table(quick, seed, sharp);
  return {{std::move(table), std::move(sharper)}, {std::move(smooth), std::move(sharp)}, why_flat};
}

}  // namespace

Study flat_limit_study() {
  return {"flat-limit", "better ways to invert the boundary matrix", "ch. 8.2",
          "The main problem is that the matrices are badly conditioned. If that is overcome the "
          "method could give stable results; a candidate is the method of Fornberg and Wright "
          "for flat radial functions.",
          redo_flat_limit};
}

}  // namespace knotlight
