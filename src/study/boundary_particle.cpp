// [V09 ch. 8.2]: Chen's boundary particle method, which needs no interior knots.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "bkm/assembly.h"
#include "bkm/dense_solver.h"
#include "bkm/global_solver.h"
#include "bkm/photon_sum.h"
#include "core/clock.h"
#include "core/not_finite.h"
#include "core/rng.h"
#include "grid/solver.h"
#include "study/experiments.h"
#include "study/lit_body.h"
#include "study/manufactured_case.h"
#include "study/multiple_reciprocity.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double side = 2.0;    // of the cube [0, 2]^3
constexpr double albedo = 0.9;  // of the lit cubes
constexpr double width = 2.0;   // of dual reciprocity's Gaussians, as in the study of fig. 7.1
const Vec3 lamp(-1.0, 1.0, 1.0);

// The cube with some source and boundary data. Every power of L on f that one can form is given.
struct Problem {
  std::string source, short_name;
  double lambda, k, sigma;                            // sigma: nan if the source has none
  std::function<double(const Vec3&, int)> power;      // L^m f at a point
  std::function<double(const Vec3&, const Vec3&)> g;  // Robin data at a point with its normal
  Eigen::VectorXd truth;                              // at manufactured_checks()
  // Of the light through the face x = 0, if any, at a point there: E, and where it travels.
  std::function<double(const Vec3&)> irradiance = {};
  std::function<Vec3(const Vec3&)> direction = {};
};

template <class F>
Eigen::VectorXd at_checks(const F& u) {
  const Points x = manufactured_checks();
  Eigen::VectorXd values(x.cols());
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = u(x.col(i));
  return values;
}

// |L^m f| grows with m, and what a step leaves over is divided by the lowest eigenvalue of -L with
// u = 0 on the cube's faces: what the first step multiplies the error by.
double step_factor(const Problem& p) {
  const double lowest = 3.0 * (pi / side) * (pi / side) + p.lambda * p.lambda;
  const auto size = [&](int m) {
    return at_checks([&](const Vec3& x) { return p.power(x, m); }).norm();
  };
  return size(1) / size(0) / lowest;
}

double relative_error(const Eigen::VectorXd& u, const Problem& p) {
  return (u - p.truth).norm() / p.truth.norm();
}

Eigen::VectorXd robin_data(const Problem& p, const SurfaceSamples& at) {
  Eigen::VectorXd g(at.positions.cols());
  for (Eigen::Index i = 0; i < g.size(); ++i) g[i] = p.g(at.positions.col(i), at.normals.col(i));
  return g;
}

// x^2 sin x cos y cos z [V09 7.1] is of the form (p sin x + q cos x) cos y cos z with quadratic p
// and q, and so are all powers of L on it.
Problem thesis_case() {
  const double lambda = manufactured_lambda();
  const auto power = [lambda](const Vec3& at, int m) {
    Vec3 p = Vec3::UnitZ(), q = Vec3::Zero();  // coefficients of 1, x, x^2
    const auto slope = [](const Vec3& c) { return Vec3(c[1], 2.0 * c[2], 0.0); };
    for (int i = 0; i <= m; ++i) {  // f itself is L u
      const double factor = 3.0 + lambda * lambda;
      const Vec3 next = slope(slope(p)) - 2.0 * slope(q) - factor * p;
      q = slope(slope(q)) + 2.0 * slope(p) - factor * q;
      p = next;
    }
    const double x = at.x();
    const Vec3 powers(1.0, x, x * x);
    return (p.dot(powers) * std::sin(x) + q.dot(powers) * std::cos(x)) * std::cos(at.y()) *
           std::cos(at.z());
  };
  return {"the thesis's known solution",
          "known",
          lambda,
          manufactured_k,
          nan,
          power,
          [](const Vec3& x, const Vec3& n) {
            return manufactured_u(x) + manufactured_k * manufactured_gradient(x).dot(n);
          },
          at_checks(&manufactured_u)};
}

// f = exp(lambda d.x), L f = 0; u = (d.x) exp(lambda d.x)/(2 lambda).
Problem ending_case() {
  const double lambda = manufactured_lambda();
  const Vec3 d = Vec3(1.0, -2.0, 2.0) / 3.0;
  const auto f = [=](const Vec3& x) { return std::exp(lambda * d.dot(x)); };
  const auto u = [=](const Vec3& x) { return d.dot(x) * f(x) / (2.0 * lambda); };
  return {"exp(lambda d.x): L f = 0",
          "",
          lambda,
          manufactured_k,
          nan,
          [=](const Vec3& x, int m) { return m == 0 ? f(x) : 0.0; },
          [=](const Vec3& x, const Vec3& n) {
            const double slope = f(x) * (1.0 + lambda * d.dot(x)) / (2.0 * lambda);
            return u(x) + manufactured_k * slope * d.dot(n);
          },
          at_checks(u)};
}

double lambda_of(double sigma) {
  return std::sqrt(3.0 * (1.0 - albedo)) * sigma;
}

double k_of(double sigma) {
  return 2.0 / (3.0 * sigma);
}

// Light along the normal of the face x = 0, up to a factor: f = -exp(-sigma x).
Problem beam(double sigma) {
  const double lambda = lambda_of(sigma), k = k_of(sigma);
  const double growth = sigma * sigma - lambda * lambda;
  const auto u = [=](const Vec3& x) { return -std::exp(-sigma * x.x()) / growth; };
  return {"a beam, exp(-sigma x)",
          "beam",
          lambda,
          k,
          sigma,
          [=](const Vec3& x, int m) { return -std::pow(growth, m) * std::exp(-sigma * x.x()); },
          [=](const Vec3& x, const Vec3& n) { return u(x) * (1.0 - k * sigma * n.x()); },
          at_checks(u),
          [](const Vec3&) { return 1.0; },
          [](const Vec3&) { return Vec3(Vec3::UnitX()); }};
}

// Cut cells and the source as points, eight in each.
Eigen::VectorXd grid_truth(const Problem& p, int cells) {
  const auto geometry = std::make_shared<const GridGeometry>(
      box_mesh(Vec3::Zero(), Vec3::Constant(side)), side / cells, Workers(1));
  GridLoad load(*geometry);
  const int across = 2 * cells;
  const double spacing = side / across, volume = spacing * spacing * spacing;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int l = 0; l < across; ++l) {
        const Vec3 x = spacing * (Vec3(i, j, l) + Vec3::Constant(0.5));
        load.add_source(x, -p.power(x, 0) * volume);
      }
  const GridSolver solver(geometry, p.lambda, p.k);
  return solver.solve(load).field.values(manufactured_checks());
}

// A lamp at a distance 1 before the middle of the face x = 0, through which all of its light comes.
Problem lit_cube(double sigma, bool quick) {
  const double lambda = lambda_of(sigma);
  std::vector<LampLight> powers{LampLight(sigma)};
  while (static_cast<int>(powers.size()) < max_order)
    powers.push_back(powers.back().helmholtz(lambda));
  Problem p{"a lamp 1 before a face",
            "lamp",
            lambda,
            k_of(sigma),
            sigma,
            [=](const Vec3& x, int m) {
              const Vec3 d = x - lamp;
              return -powers[static_cast<std::size_t>(m)].value(d.norm(), d.x() / d.norm());
            },
            [](const Vec3&, const Vec3&) { return 0.0; },
            {},
            [](const Vec3& x) { return std::pow((x - lamp).norm(), -3.0); },
            [](const Vec3& x) { return Vec3((x - lamp).normalized()); }};
  p.truth = grid_truth(p, quick ? 16 : 64);
  return p;
}

Eigen::MatrixXd chain_of(const Problem& p, const Points& at, int steps) {
  Eigen::MatrixXd chain(at.cols(), steps);
  for (Eigen::Index i = 0; i < at.cols(); ++i)
    for (int m = 0; m < steps; ++m) chain(i, m) = p.power(at.col(i), m);
  return chain;
}

// The composite chain [CFJ10] with lap - sigma^2, which ends a beam at once: u_p is a sum of
// non-singular solutions for sigma, and (lap - lambda^2) of one is (sigma^2 - lambda^2) times it.
Eigen::VectorXd matched_operator(const Problem& p, const SurfaceSamples& knots) {
  RadialFunction for_sigma, for_lambda;
  for_sigma.kind = for_lambda.kind = RadialKind::nonsingular;
  for_sigma.order = for_lambda.order = 0;
  for_sigma.R = for_lambda.R = diameter(knots.positions);
  for_sigma.lambda = p.sigma;
  for_lambda.lambda = p.lambda;
  const Points& x = knots.positions;
  const Points checks = manufactured_checks(), none = Points::Zero(3, checks.cols());
  const DenseSolver source(robin_matrix(x, knots.normals, x, 0.0, for_sigma));
  const Eigen::VectorXd alpha =
      source.solve(chain_of(p, x, 1).col(0)) / (p.sigma * p.sigma - p.lambda * p.lambda);
  const DenseSolver boundary(robin_matrix(x, knots.normals, x, p.k, for_lambda));
  const Eigen::VectorXd beta = boundary.solve(
      robin_data(p, knots) - robin_matrix(x, knots.normals, x, p.k, for_sigma) * alpha);
  return robin_matrix(checks, none, x, 0.0, for_sigma) * alpha +
         robin_matrix(checks, none, x, 0.0, for_lambda) * beta;
}

Eigen::VectorXd dual_reciprocity(const Problem& p, const SurfaceSamples& knots, int lattice,
                                 const Eigen::VectorXd& noise) {
  BkmThesisProblem problem = manufactured_problem(1, lattice).problem;
  problem.lambda = p.lambda;
  problem.k = p.k;
  problem.boundary_points = knots.positions;
  problem.boundary_normals = knots.normals;
  BkmThesisOptions options;
  options.c = width;
  Eigen::VectorXd f = chain_of(p, all_points(problem), 1).col(0);
  f.head(noise.size()) += noise;
  return BkmThesisSolver(problem, options)
      .solve(f, robin_data(p, knots))
      .values(manufactured_checks());
}

// First interactions of light that enters at random places of the face x = 0: -sum q delta is f.
struct Photons {
  Points positions;
  Eigen::VectorXd strengths;
};

Photons photons_of(const Problem& p, Eigen::Index count, std::uint64_t seed) {
  Points positions(3, count);
  Eigen::VectorXd strengths(count);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    Rng rng(seed, Stream::photons, static_cast<std::uint64_t>(i));
    const double y = side * rng.uniform(), z = side * rng.uniform();
    const Vec3 enters(0.0, y, z);
    const Vec3 x = enters - std::log1p(-rng.uniform()) / p.sigma * p.direction(enters);
    if (x.maxCoeff() > side || x.minCoeff() < 0.0) continue;
    positions.col(kept) = x;
    strengths[kept++] = p.irradiance(enters) * side * side / (static_cast<double>(count) * p.sigma);
  }
  return {positions.leftCols(kept), strengths.head(kept)};
}

// As it should be: each photon is a charge with the image in its nearest face, and sources on a
// cube twice as large do the rest.
Eigen::VectorXd charges(const Problem& p, const Photons& photons, int n) {
  constexpr double cut = 1e-12, larger = 2.0;
  const Eigen::Index count = photons.positions.cols();
  PointSources sources{photons.positions, photons.strengths, Points(3, count),
                       Points::Zero(3, count), Eigen::VectorXd::Constant(count, infinity)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 x = photons.positions.col(i);
    int axis = 0;
    const double depth = (0.5 * side - (x.array() - 0.5 * side).abs()).minCoeff(&axis);
    const double outward = x[axis] < 0.5 * side ? -1.0 : 1.0;
    sources.plane_normals(axis, i) = outward;
    sources.plane_points.col(i) = x + outward * depth * Vec3::Unit(axis);
  }
  const Workers alone(1);
  const PhotonSum sum(std::move(sources), p.lambda, p.k, {}, alone);
  const SurfaceSamples centers = cube_face_knots(n), rows = cube_face_knots(n + 4);
  const Points checks = manufactured_checks();
  const PhotonSumValues at_rows = sum.evaluate(rows.positions, &rows.normals, alone);
  const Vec3 middle = Vec3::Constant(0.5 * side);
  const GlobalBkmSolver solver(
      {p.lambda, p.k, (larger * (centers.positions.colwise() - middle)).colwise() + middle,
       rows.positions, rows.normals},
      GlobalBasis::exterior_sources, cut, alone);
  const GlobalField rest =
      solver.solve(robin_data(p, rows) - at_rows.value - p.k * at_rows.normal_derivative);
  Eigen::VectorXd u = sum.evaluate(checks, nullptr, alone).value;
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] += rest.value(checks.col(i));
  return u;
}

// What a density estimate of the photons (Gaussians of width h) and L^m of it have of noise, at
// points: every other photon with a minus sign has the same noise and no mean.
Eigen::MatrixXd noise_of(const Problem& p, const Photons& photons, const Points& at, double h,
                         int steps) {
  constexpr double reach = 6.0;  // widths: e^-18 of the Gaussian's height
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(at.cols(), steps);
  for (Eigen::Index i = 0; i < at.cols(); ++i)
    for (Eigen::Index j = 0; j < photons.positions.cols(); ++j) {
      const double r2 = (at.col(i) - photons.positions.col(j)).squaredNorm();
      if (r2 > reach * reach * h * h) continue;
      const double q = j % 2 == 0 ? photons.strengths[j] : -photons.strengths[j];
      for (int m = 0; m < steps; ++m) noise(i, m) += q * gaussian_power(m, r2, h, p.lambda);
    }
  return noise;
}

Eigen::VectorXd boundary_particles(const Problem& p, const SurfaceSamples& knots,
                                   const Eigen::MatrixXd& chain) {
  const BoundaryParticles particles(p.lambda, p.k, knots);
  return particles.values(particles.solve(chain, robin_data(p, knots)), manufactured_checks());
}

const char* const dual = "after its method: dual reciprocity";
const char* const chained = "boundary particles, one operator";
const char* const as_charges = "as it should be: photons as charges, sources outside";

const char* const why_particles =
    "Where the chain ends, the method is as good as its name: for L f = 0, 384 knots give 8e-7 "
    "where dual reciprocity with 727 gives 7e-6, in half of the time, there being no knots inside. "
    "(One matrix serves all steps; the boundary condition of diffusion needs a second one.) With "
    "the operator that ends a beam, lap - sigma², one step gives 6e-7 to 7e-4. With L itself the "
    "chain is a series: each step multiplies what is left by (sigma² - lambda²) over the lowest "
    "eigenvalue of the body. That is 0.3 for a cube of four mean free paths; at twenty it is 1.9, "
    "and each step makes it worse. The known solution of the thesis has powers that "
    "grow as m² 6^m, and keeps 5 % for as long as there are functions for it. A lamp has no "
    "operator that ends its light, and the powers of L on 1/r² grow as (2m)!: the chain diverges "
    "at any size. And this is with all powers in closed form, of a lamp whose light comes through "
    "one flat face; at the edge of a shadow on a curved one the second derivative is infinite "
    "already. From photons' densities the noise grows tenfold and more with each step, from 0.5 % "
    "of f to 50 times what is asked for, so that the third step does more harm than good. The "
    "method trades knots inside for derivatives of the source, and those are what light does not "
    "have. Photons as charges need neither: their error is the noise of 100 000 photons and, "
    "about as large, what images leave at the edges (for the lamp also the truth's own error), "
    "whatever the source looks like.";

StudyTable noise_table(bool quick, int n, std::uint64_t seed) {
  constexpr double sigma = 2.0, h = 0.25;  // half a mean free path, about a knot spacing
  const Problem p = beam(sigma);
  const SurfaceSamples knots = cube_face_knots(n);
  const Photons photons = photons_of(p, quick ? 5000 : 50000, seed);
  const Points all = all_points(manufactured_problem(n, n - 1).problem);
  const Eigen::MatrixXd noise = noise_of(p, photons, knots.positions, h, max_order);
  const Eigen::VectorXd everywhere = noise_of(p, photons, all, h, 1);
  StudyTable table{
      "noise",
      fmt::format("The beam in a cube of 4 mean free paths, where the chain converges, with "
                  "densities from {} photons inside (Gaussians of half a mean free path; without "
                  "the bias of such estimates). Noise: of the last power of L on f that is asked "
                  "for, rms over its own rms at the boundary knots",
                  photons.positions.cols()),
      {"way", "steps", "noise", "error, exact density", "error, photons' density"},
      {}};
  const Eigen::MatrixXd chain = chain_of(p, knots.positions, max_order);
  table.rows.push_back({dual, nan, everywhere.norm() / chain_of(p, all, 1).norm(),
                        relative_error(dual_reciprocity(p, knots, n - 1, {}), p),
                        relative_error(dual_reciprocity(p, knots, n - 1, everywhere), p)});
  for (int steps = 1; steps <= max_order; ++steps) {
    const Eigen::MatrixXd exact = chain.leftCols(steps);
    table.rows.push_back(
        {chained, static_cast<double>(steps),
         noise.col(steps - 1).norm() / chain.col(steps - 1).norm(),
         relative_error(boundary_particles(p, knots, exact), p),
         relative_error(boundary_particles(p, knots, exact + noise.leftCols(steps)), p)});
  }
  table.rows.push_back({as_charges, nan, nan, nan, relative_error(charges(p, photons, n), p)});
  return table;
}

StudyFindings redo_boundary_particle(StudyBench& bench) {
  const bool quick = bench.options.quick;
  const std::uint64_t seed = bench.run.options.seed;
  const int n = quick ? 5 : 8, lattice = n - 1;
  const SurfaceSamples knots = cube_face_knots(n);
  const auto count = static_cast<double>(knots.positions.cols());
  const double inside = std::pow(lattice, 3);
  const Eigen::Index photons = quick ? 5000 : 100000;
  std::vector<Problem> problems{ending_case(), thesis_case()};
  for (const double sigma : quick ? std::vector{4.0} : std::vector{2.0, 4.0, 10.0})
    problems.push_back(beam(sigma));
  for (const double sigma : quick ? std::vector{4.0} : std::vector{2.0, 4.0, 10.0})
    problems.push_back(lit_cube(sigma, quick));
  StudyTable table{
      "",
      "Relative L2 error at 400 points of the cube, half of them inside. Step factor: rms of L f "
      "over that of f, over the lowest eigenvalue of -L; steps: how many powers of L on f are "
      "used; matrices: that are decomposed. Truth: closed form; of the lamp, a grid of 64 cells "
      "per edge (right to 1e-3 to 1e-2)",
      {"way", "source", "side in mean free paths", "step factor", "steps", "matrices", "knots",
       "error", "seconds"},
      {}};
  StudyChart chart{
      "",
      {"A chain of operators", "steps", "relative error", false, true, {}},
      "Only in small bodies does the chain converge. Numbers: side in mean free paths."};
  for (const Problem& p : problems) {
    const double factor = step_factor(p), across = side * p.sigma;
    const auto measure = [&](const std::string& way, double steps, double matrices, double unknowns,
                             const std::function<Eigen::VectorXd()>& solve) {
      const double start = cpu_seconds();
      const double error = relative_error(solve(), p);
      table.rows.push_back(
          {way, p.source, across, factor, steps, matrices, unknowns, error, cpu_seconds() - start});
      return error;
    };
    measure(dual, nan, 2.0, count + inside,
            [&] { return dual_reciprocity(p, knots, lattice, {}); });
    ChartSeries series{
        p.short_name + (std::isnan(across) ? "" : fmt::format(", {}", across)), {}, {}, {}};
    for (int steps = 1; steps <= (factor == 0.0 ? 1 : max_order); ++steps) {
      series.x.push_back(steps);
      series.y.push_back(measure(chained, steps, 2.0, count, [&] {
        return boundary_particles(p, knots, chain_of(p, knots.positions, steps));
      }));
    }
    // A chain that ends is no line.
    if (factor > 0.0) chart.chart.series.push_back(std::move(series));
    if (p.irradiance) {
      measure("boundary particles, operator of the beam", 1.0, 2.0, count,
              [&] { return matched_operator(p, knots); });
      measure(as_charges, nan, 1.0, count,
              [&] { return charges(p, photons_of(p, photons, seed), n); });
    }
  }
  return {{std::move(table), noise_table(quick, n, seed)}, {std::move(chart)}, why_particles};
}

}  // namespace

Study boundary_particle_study() {
  return {"boundary-particle", "the boundary particle method", "ch. 8.2",
          "The boundary particle method, a successor of the boundary knot method, needs no "
          "interior points for inhomogeneous problems and sets up one matrix; whether it gives "
          "better and more stable results for diffusion remains to be seen.",
          redo_boundary_particle};
}

}  // namespace knotlight
