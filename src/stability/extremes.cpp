#include "stability/extremes.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/errors.h"
#include "pipeline/plan.h"
#include "pipeline/solve_scene.h"
#include "reference/ball_p1.h"
#include "reference/slab_p1.h"
#include "reference/sphere_beam_p1.h"
#include "stability/shapes.h"

namespace knotlight {
namespace {

constexpr double tolerance = 0.02;          // coarse, so that small photon numbers can meet it
constexpr double tolerances_allowed = 3.0;  // as solve_object.cpp has it
constexpr std::size_t photons = 200'000;
// Of a quick run: as few as the program takes seriously, knots in proportion.
constexpr std::size_t quick_photons = 20'000;
constexpr std::size_t quick_knots = 100;
// The grid that stands in where there is no closed form: half the cell size, ten times the light.
constexpr double reference_tolerance = tolerance / 4.0;
constexpr std::size_t reference_photons = 2'000'000;
constexpr std::size_t checks = 1000;
constexpr double closed_form_uncertainty = 0.001;  // of the ball's series for sharp shadows

Medium medium(double extinction, double albedo, double g = 0.0, double ior = 1.0) {
  return {extinction * (1.0 - albedo), extinction * albedo, g, ior, 0.0};
}

Scene scene_of(Shape shape, const Medium& m, const Light& light) {
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(m.sigma_a);
  material.sigma_s = Spectrum::Constant(m.sigma_s);
  material.g = Spectrum::Constant(m.g);
  material.ior = m.ior;
  Scene scene;
  scene.objects = {{"body", std::move(shape), material}};
  scene.lights = {light};
  scene.solver.source = SourceModel::photon_map;
  scene.solver.boundary = Boundary::marshak;
  scene.solver.tolerance = tolerance;
  scene.solver.photons = photons;
  return scene;
}

Light beam(const Vec3& direction) {
  return DirectionalLight{direction.normalized(), Spectrum::Ones()};
}

RunContext context_for(std::uint64_t seed) {
  RunOptions options;
  options.seed = seed;
  options.threads = 1;
  options.quiet = true;
  return {options, false};
}

// Of the plate, where its rim is too far away to matter.
bool far_from_rim(const Vec3& x, const Vec3& n) {
  return std::abs(n.z()) > 0.5 && std::max(std::abs(x.x()), std::abs(x.y())) < 0.6;
}

SolvedScene solve(Scene scene, Method method, std::uint64_t seed) {
  scene.solver.method = method;
  RunContext run = context_for(seed);
  return solve_scene(prepare_scene(std::move(scene)), run);
}

}  // namespace

std::vector<ExtremeScene> extreme_scenes(bool quick) {
  using enum ExtremeScene::Truth;
  const Light down = beam(-Vec3::UnitZ());
  const Light oblique = beam({0.5, 0.3, -1.0});
  const Light lamp = PointLight{Vec3::Zero(), Spectrum::Ones()};
  const Vec3 up = Vec3::UnitZ();
  const double small_gap = 1e-3;
  std::vector<ExtremeScene> all{
      // clang-format off
      {"tiny ball", "one mean free path across", scene_of(Sphere{}, medium(0.5, 0.99), down), ball_under_beam},
      {"huge ball", "1000 mean free paths across", scene_of(Sphere{}, medium(500.0, 0.99), down), ball_under_beam},
      {"dark ball", "albedo 0.5", scene_of(Sphere{}, medium(20.0, 0.5), down), ball_under_beam},
      {"bright ball", "albedo 0.99999", scene_of(Sphere{}, medium(20.0, 0.99999), down), ball_under_beam},
      {"no absorption", "sigma_a = 0, lambda = 0", scene_of(Sphere{}, medium(20.0, 1.0), down), ball_under_beam},
      {"forward", "g = 0.95", scene_of(Sphere{}, medium(100.0, 0.995, 0.95), down), ball_under_beam},
      {"glass lamp", "ior 1.5, a lamp inside", scene_of(Sphere{}, medium(10.0, 0.99, 0.0, 1.5), lamp), lamp_in_ball},
      {"thin plate", "2 x 2 x 0.04, four mean free paths thick", scene_of(box_mesh({-1, -1, 0}, {1, 1, 0.04}), medium(100.0, 0.99), down), slab},
      {"needle", "1 : 0.02, six mean free paths thick", scene_of(ellipsoid_mesh(Vec3::Zero(), {1, 0.02, 0.02}, 0.1), medium(150.0, 0.99), oblique), fine_grid},
      {"tetrahedron", "edges of 71 degrees, tips", scene_of(tetrahedron_mesh(Vec3::Zero(), up, 1.6), medium(15.0, 0.98), oblique), fine_grid},
      {"star", "spikes and reentrant edges", scene_of(star_mesh(), medium(10.0, 0.98), oblique), fine_grid},
      {"balls with a gap", "two balls 0.001 apart in one mesh", scene_of(both(ellipsoid_mesh({-0.5 - 0.5 * small_gap, 0, 0}, Vec3::Constant(0.5), 0.15), ellipsoid_mesh({0.5 + 0.5 * small_gap, 0, 0}, Vec3::Constant(0.5), 0.15)), medium(20.0, 0.98), oblique), fine_grid},
      {"plates with a gap", "two boxes face to face, 0.001 apart", scene_of(both(box_mesh({-1, -1, 0}, {1, 1, 0.3}), box_mesh({-1, -1, -0.3 - small_gap}, {1, 1, -small_gap})), medium(20.0, 0.98), oblique), fine_grid},
      {"touching tips", "two tetrahedra that share a point", scene_of(both(tetrahedron_mesh(Vec3::Zero(), up, 1.0), tetrahedron_mesh(Vec3::Zero(), -up, 1.0)), medium(20.0, 0.98), oblique), fine_grid},
      // clang-format on
  };
  if (!quick) return all;
  std::vector<ExtremeScene> few{all[0], all[4]};
  for (ExtremeScene& extreme : few) {
    extreme.scene.solver.photons = quick_photons;
    extreme.scene.solver.knots = quick_knots;
  }
  return few;
}

SurfaceTruth truth_of(const ExtremeScene& extreme, std::uint64_t seed) {
  const Scene& scene = extreme.scene;
  const Shape& shape = scene.objects[0].shape;
  const Medium m = scene.objects[0].translucent()->medium(0);
  const Boundary boundary = scene.solver.boundary;
  const bool plate = extreme.truth == ExtremeScene::Truth::slab;
  std::vector<Vec3> places;
  // Seeds near to a run's own are those of the points that it judges itself at.
  constexpr std::uint64_t apart = 1000;
  for (const SurfacePoint& p :
       stratified_surface_points(shape, checks, true, seed + apart, Stream::check_points))
    if (!plate || far_from_rim(p.position, p.normal)) places.push_back(p.position);

  SurfaceTruth truth;
  const auto n = static_cast<Eigen::Index>(places.size());
  truth.positions.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) truth.positions.col(i) = places[static_cast<std::size_t>(i)];
  truth.U_d.resize(n);
  truth.uncertainty = closed_form_uncertainty;
  switch (extreme.truth) {
    case ExtremeScene::Truth::ball_under_beam: {
      truth.source = "series";
      const SphereBeamP1 ball(m, boundary, 1.0);
      for (Eigen::Index i = 0; i < n; ++i) truth.U_d[i] = ball.U_d(truth.positions.col(i));
      break;
    }
    case ExtremeScene::Truth::lamp_in_ball: {
      truth.source = "closed form";
      const double power = 4.0 * std::numbers::pi;  // of the lamp; the closed form's is 1 W
      truth.U_d.setConstant(power * LampInBallP1(m, boundary, 1.0).U_d(1.0));
      break;
    }
    case ExtremeScene::Truth::slab: {
      truth.source = "closed form of the slab, away from the rim";
      const double top = bounds(shape).hi.z();
      const SlabP1 slab(m, boundary, top - bounds(shape).lo.z());
      for (Eigen::Index i = 0; i < n; ++i) truth.U_d[i] = slab.U_d(top - truth.positions(2, i));
      break;
    }
    case ExtremeScene::Truth::fine_grid: {
      truth.source = "grid of half the cell size, 2 million photons";
      Scene fine = scene;
      fine.solver.tolerance = reference_tolerance;
      fine.solver.photons = reference_photons;
      fine.solver.knots.reset();
      const SolvedScene solved = solve(std::move(fine), Method::grid, seed + apart);
      truth.U_d = solved.objects[0][0].U_d(truth.positions);
      truth.uncertainty = solved.objects[0][0].report.error_estimate;
      break;
    }
  }
  return truth;
}

ExtremeTrial try_extreme(const ExtremeScene& extreme, Method method, const SurfaceTruth& truth,
                         std::uint64_t seed) {
  ExtremeTrial trial;
  trial.scene = extreme.name;
  trial.method = name_of(method);
  trial.allowed = tolerances_allowed * extreme.scene.solver.tolerance + truth.uncertainty;
  trial.error = trial.error_estimate = std::numeric_limits<double>::quiet_NaN();
  const auto start = std::chrono::steady_clock::now();
  try {
    const SolvedScene solved = solve(extreme.scene, method, seed);
    const SolvedChannel& channel = solved.objects[0][0];
    trial.failures = solved.report.failures;
    trial.exit_code = trial.failures.empty() ? exit_ok : exit_untrusted;
    trial.error_estimate = channel.report.error_estimate;
    const Eigen::VectorXd U_d = channel.U_d(truth.positions);
    trial.finite = U_d.allFinite();
    trial.error = (U_d - truth.U_d).norm() / truth.U_d.norm();
  } catch (const InputError& refusal) {
    trial.exit_code = exit_bad_input;
    trial.failures = {refusal.what()};
  } catch (const std::exception& crash) {
    trial.exit_code = exit_failure;
    trial.failures = {crash.what()};
  }
  trial.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return trial;
}

}  // namespace knotlight
