#include "study/lit_body.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/clock.h"
#include "study/timed_solve.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double cube_size = 2.0;
// Of the answers: what keeps the truth three times better than what is measured against it, at a
// few seconds each.
constexpr double truth_tolerance = 0.004, ours_tolerance = 0.01, quick_tolerance = 0.05;
constexpr std::size_t truth_photons = 2'000'000, ours_photons = 1'000'000, quick_photons = 50'000;
constexpr std::size_t check_count = 600;
// Seeds near to a run's own are those of the points and photons it judges itself by.
constexpr std::uint64_t apart = 1000;

Scene scene_of(const LitBody& body) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(body.medium.sigma_a);
  material.sigma_s = Spectrum::Constant(body.medium.sigma_s);
  material.g = Spectrum::Constant(body.medium.g);
  Scene scene;
  scene.objects = {{"body", body.shape(), material}};
  scene.lights = {body.lamp()};
  scene.solver.source = SourceModel::photon_map;
  scene.solver.boundary = Boundary::marshak;
  scene.solver.diffusion = Diffusion::p1;
  scene.solver.similarity = true;
  return scene;
}

struct Solved {
  FieldValues U_d;
  double error_estimate, seconds;
};

Solved solve_by(Method method, const LitBody& body, double tolerance, std::size_t photons,
                std::uint64_t seed, int threads) {
  Scene scene = scene_of(body);
  scene.solver.method = method;
  scene.solver.tolerance = tolerance;
  scene.solver.photons = photons;
  const auto [solved, seconds] = timed_solve(std::move(scene), seed, threads);
  const SolvedChannel& channel = solved.objects[0][0];
  return {channel.U_d, channel.report.error_estimate, seconds};
}

}  // namespace

Medium thesis_medium(double scale, double g) {
  return {0.0421 * scale, 3.055 * scale, g, 1.0, 0.0};
}

Shape LitBody::shape() const {
  if (which == LitShape::ball) return Sphere{};
  return box_mesh(Vec3::Zero(), Vec3::Constant(cube_size));
}

PointLight LitBody::lamp() const {
  return {which == LitShape::ball ? Vec3(-3.0, 0.0, 0.0) : Vec3(-1.0, -1.0, 1.0), Spectrum::Ones()};
}

double LitBody::depth(const Vec3& x) const {
  if (which == LitShape::ball) return 1.0 - x.norm();
  return std::min(x.minCoeff(), (Vec3::Constant(cube_size) - x).minCoeff());
}

double LitBody::irradiance(const SurfacePoint& at) const {
  const Vec3 to_lamp = lamp().position - at.position;
  const double r = to_lamp.norm();
  return std::max(0.0, to_lamp.dot(at.normal)) / (r * r * r);
}

SurfaceSamples cube_face_knots(int n, double lo) {
  SurfaceSamples s{Points(3, 6 * n * n), Points(3, 6 * n * n)};
  Eigen::Index at = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          Vec3 p;
          p(axis) = lo + side * cube_size;
          p((axis + 1) % 3) = lo + cube_size * (i + 0.5) / n;
          p((axis + 2) % 3) = lo + cube_size * (j + 0.5) / n;
          s.positions.col(at) = p;
          s.normals.col(at++) = (2.0 * side - 1.0) * Vec3::Unit(axis);
        }
  return s;
}

SurfaceSamples cube_triangle_knots(int n) {
  const TriangleMesh mesh = box_mesh(Vec3::Zero(), Vec3::Constant(cube_size));
  std::vector<SurfacePoint> points;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        // Equal areas of the unit square to equal areas of the triangle [PBRT ch. 13.6.5].
        const double root = std::sqrt((i + 0.5) / n), along = (j + 0.5) / n;
        points.push_back({(1.0 - root) * mesh.corner(t, 0) + along * root * mesh.corner(t, 1) +
                              (1.0 - along) * root * mesh.corner(t, 2),
                          mesh.normal(t)});
      }
  return columns(points);
}

SurfaceSamples ball_knots(int n, bool jitter, std::uint64_t seed) {
  std::vector<SurfacePoint> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      Rng rng(seed, Stream::boundary_knots, static_cast<std::uint64_t>(i * n + j));
      const double u = jitter ? rng.uniform() : 0.5, v = jitter ? rng.uniform() : 0.5;
      const double z = 1.0 - 2.0 * (i + u) / n, phi = 2.0 * pi * (j + v) / n;
      const double rho = std::sqrt(1.0 - z * z);
      const Vec3 x(rho * std::cos(phi), rho * std::sin(phi), z);
      points.push_back({x, x});
    }
  return columns(points);
}

ThesisSetup usual_setup(const LitBody& body, bool quick, std::uint64_t seed) {
  ThesisSetup setup;
  if (body.which == LitShape::ball)
    setup.knots = ball_knots(quick ? 10 : 22, true, seed);
  else
    setup.knots = cube_face_knots(quick ? 4 : 8);
  setup.layers = {1.5};
  setup.options.c = 500.0;
  return setup;
}

ThesisProblem thesis_problem(const LitBody& body, const ThesisSetup& setup) {
  const double l = 1.0 / body.medium.sigma_tr();
  const Points& knots = setup.knots.positions;
  const Points& normals = setup.knots.normals;
  const Eigen::Index n = knots.cols();
  const auto layers = static_cast<Eigen::Index>(setup.layers.size());
  Points interior(3, n * (1 + layers) + setup.more.cols());
  interior.leftCols(n) = knots - l * normals;
  for (Eigen::Index i = 0; i < layers; ++i)
    interior.middleCols(n * (1 + i), n) =
        knots - setup.layers[static_cast<std::size_t>(i)] * l * normals;
  interior.rightCols(setup.more.cols()) = setup.more;

  const DiffusionCoefficients c = diffusion_coefficients(body.medium, Boundary::marshak);
  ThesisProblem p{{c.lambda, c.k, knots, normals, interior},
                  Eigen::VectorXd::Zero(n + interior.cols()),
                  Eigen::VectorXd::Zero(n)};
  const double per_light =
      -3.0 * body.medium.sigma_tr() * std::exp(-body.medium.sigma_t() * l) / (4.0 * pi);
  Eigen::Index outside = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    p.f[n + i] = per_light * body.irradiance({knots.col(i), normals.col(i)});
    if (body.depth(interior.col(i)) < 0.0) ++outside;
  }
  p.outside = static_cast<double>(outside) / static_cast<double>(n);
  return p;
}

ThesisAnswer thesis_answer(const ThesisProblem& p, const BkmThesisOptions& options) {
  const double start = cpu_seconds();
  const BkmThesisSolver solver(p.problem, options);
  ThesisAnswer answer;
  answer.field = solver.solve(p.f, p.g);
  answer.seconds = cpu_seconds() - start;
  answer.particular_rank = solver.particular_rank();
  answer.homogeneous_rank = solver.homogeneous_rank();
  answer.particular_condition = solver.particular_condition();
  answer.homogeneous_condition = solver.homogeneous_condition();
  return answer;
}

double shape_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth) {
  const double factor = u.dot(truth) / u.squaredNorm();
  // Not std::max, which would turn not-a-number into 0.
  return (factor < 0.0 ? truth : Eigen::VectorXd(factor * u - truth)).norm() / truth.norm();
}

const RightAnswer& LitBodies::right(const LitBody& body) {
  const std::string key = fmt::format("{} {} {} {}", body.which == LitShape::ball,
                                      body.medium.sigma_a, body.medium.sigma_s, body.medium.g);
  const auto found = solved_.find(key);
  return found != solved_.end() ? found->second : solved_.emplace(key, solve(body)).first->second;
}

RightAnswer LitBodies::solve(const LitBody& body) const {
  const std::uint64_t seed = run_.options.seed;
  RightAnswer right;
  right.positions = columns(stratified_surface_points(body.shape(), check_count, true, seed + apart,
                                                      Stream::check_points))
                        .positions;
  const Solved truth =
      solve_by(Method::grid, body, quick_ ? quick_tolerance : truth_tolerance,
               quick_ ? 2 * quick_photons : truth_photons, seed + apart, run_.options.threads);
  const Solved ours = solve_by(Method::lbkm, body, quick_ ? quick_tolerance : ours_tolerance,
                               quick_ ? quick_photons : ours_photons, seed, 1);
  right.truth = truth.U_d(right.positions);
  right.truth_at = truth.U_d;
  right.truth_uncertainty = truth.error_estimate;
  right.ours_at = ours.U_d;
  right.error = (ours.U_d(right.positions) - right.truth).norm() / right.truth.norm();
  right.error_estimate = ours.error_estimate;
  right.seconds = ours.seconds;
  return right;
}

}  // namespace knotlight
