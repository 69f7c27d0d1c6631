// Every option of `method: bkm_thesis` through the whole pipeline, on a ball that glows by itself:
// U = P (1 - C sinh(lambda r) / r), see solve_scene_test.cpp. No photons, no noise.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "pipeline/solve_scene.h"

namespace knotlight {
namespace {

constexpr double pi = std::numbers::pi;
const Medium glowing{0.5, 4.5, 0.0, 1.0, 2.0};

SolvedChannel solve(const BkmThesisSettings& thesis, const Shape& shape = Sphere{}) {
  PreparedScene prepared;
  Scene& scene = prepared.scene;
  TranslucentMaterial material;
  material.sigma_a = Spectrum::Constant(glowing.sigma_a);
  material.sigma_s = Spectrum::Constant(glowing.sigma_s);
  material.emission = Spectrum::Constant(glowing.emission);
  scene.objects = {{"body", shape, material}};
  scene.solver.method = Method::bkm_thesis;
  scene.solver.photons = 1000;
  scene.solver.knots = 120;
  scene.solver.boundary = Boundary::marshak;
  scene.solver.thesis = thesis;
  prepared.caster = std::make_unique<RayCaster>(std::vector<const Shape*>{&scene.objects[0].shape});
  prepared.translucent = {0};
  RunContext run(RunOptions{}, false);
  return solve_scene(prepared, run).objects[0][0];
}

double figure(const SolvedChannel& channel, const std::string& name) {
  for (const auto& [key, value] : channel.report.figures)
    if (key == name) return value;
  ADD_FAILURE() << "no figure " << name;
  return std::numeric_limits<double>::quiet_NaN();
}

// Largest error over P, from the centre to the surface.
double error_of(const SolvedChannel& channel) {
  const DiffusionCoefficients c = diffusion_coefficients(glowing, Boundary::marshak);
  const double P = glowing.emission / (4.0 * pi * glowing.sigma_a), l = c.lambda;
  const double C = 1.0 / (std::sinh(l) + c.k * (l * std::cosh(l) - std::sinh(l)));
  double largest = 0.0;
  for (const double r : {0.05, 0.3, 0.6, 0.9, 1.0}) {
    const double u = channel.U_d_at(r * Vec3(0.6, 0.0, 0.8));
    largest = std::max(largest, std::abs(u / P - (1.0 - C * std::sinh(l * r) / r)));
  }
  return largest;
}

struct Option {
  const char* name;
  std::function<void(BkmThesisSettings&)> set;
  double allowed;  // three times what was measured
};
const Option options[] = {
    {"default", [](auto&) {}, 0.0002},
    {"vertices", [](auto& s) { s.knot_layout = KnotLayout::vertices; }, 7e-05},
    {"stratified", [](auto& s) { s.knot_layout = KnotLayout::stratified; }, 0.0002},
    {"blue_noise", [](auto& s) { s.knot_layout = KnotLayout::blue_noise; }, 0.0002},
    {"none", [](auto& s) { s.interior_knots = InteriorLayout::none; }, 0.2},
    {"one_layer", [](auto& s) { s.interior_knots = InteriorLayout::one_layer; }, 0.005},
    {"near_layers", [](auto& s) { s.interior_knots = InteriorLayout::near_layers; }, 0.0002},
    {"grid", [](auto& s) { s.interior_knots = InteriorLayout::grid; }, 1e-07},
    {"cubic", [](auto& s) { s.radial_function = RadialKind::cubic; }, 0.2},
    {"inverse_multiquadric", [](auto& s) { s.radial_function = RadialKind::inverse_multiquadric; },
     0.005},
    {"exponent 1",
     [](auto& s) {
       s.radial_function = RadialKind::inverse_multiquadric;
       s.radial_exponent = 1.0;
     },
     0.0008},
    {"nonsingular 2",
     [](auto& s) {
       s.radial_function = RadialKind::nonsingular;
       s.radial_order = 2;
     },
     0.1},
    {"width 4", [](auto& s) { s.shape_parameter = 4.0; }, 0.01},
    {"leave_one_out", [](auto& s) { s.leave_one_out = true; }, 5e-05},
    {"basis_order 1", [](auto& s) { s.basis_order = 1; }, 0.005},
    {"qr", [](auto& s) { s.dense_solver = DenseMethod::qr; }, 0.0002},
    {"tikhonov_gcv", [](auto& s) { s.dense_solver = DenseMethod::tikhonov_gcv; }, 0.0002},
    {"tikhonov_l_curve", [](auto& s) { s.dense_solver = DenseMethod::tikhonov_l_curve; }, 0.006},
    {"cut", [](auto& s) { s.svd_cut = 1e-6; }, 0.006},
    {"lu", [](auto& s) { s.dense_solver = DenseMethod::lu; },
     std::numeric_limits<double>::infinity()},
    {"float", [](auto& s) { s.distance_precision = DistancePrecision::single_precision; },
     std::numeric_limits<double>::infinity()},
};

// Each does something (no two give the same field) and none loses the solution but the two that
// are there to show it.
TEST(SolveBkmThesis, EveryOptionReachesTheSolver) {
  const Vec3 somewhere(0.3, -0.2, 0.4);
  std::vector<double> values;
  for (const Option& option : options) {
    BkmThesisSettings settings;
    option.set(settings);
    const SolvedChannel channel = solve(settings);
    const double error = error_of(channel);
    EXPECT_LE(error, option.allowed) << option.name;
    RecordProperty(option.name, fmt::format("{:.2g}", error));
    for (const double other : values) EXPECT_NE(channel.U_d_at(somewhere), other) << option.name;
    values.push_back(channel.U_d_at(somewhere));
  }
}

TEST(SolveBkmThesis, FiguresTellWhatWasDone) {
  BkmThesisSettings settings;
  const SolvedChannel plain = solve(settings);
  EXPECT_EQ(figure(plain, "boundary_knots"), 120);
  EXPECT_EQ(figure(plain, "interior_knots"), 240);
  EXPECT_EQ(figure(plain, "leave_one_out_factorisations"), 0);
  EXPECT_EQ(figure(plain, "particular_regulariser"), 0.0);
  EXPECT_NEAR(figure(plain, "radial_width"), 8.0 * std::sqrt(4.0 * pi / 120), 1e-12);
  EXPECT_GE(figure(plain, "particular_effective_condition"), 1.0);
  EXPECT_LE(figure(plain, "particular_effective_condition"), figure(plain, "particular_condition"));
  EXPECT_GE(figure(plain, "homogeneous_effective_condition"), 1.0);

  settings.leave_one_out = true;
  settings.dense_solver = DenseMethod::tikhonov_gcv;
  settings.knot_layout = KnotLayout::vertices;
  settings.interior_knots = InteriorLayout::none;
  const SolvedChannel other = solve(settings);
  EXPECT_EQ(figure(other, "boundary_knots"), 92);  // an icosahedron's 10 n^2 + 2
  EXPECT_EQ(figure(other, "interior_knots"), 0);
  EXPECT_GT(figure(other, "leave_one_out_factorisations"), 4);
  EXPECT_GT(figure(other, "particular_regulariser"), 0.0);
  EXPECT_TRUE(std::isfinite(figure(other, "leave_one_out_error")));
}

// A box has 8 corners: all that `vertices` can give.
TEST(SolveBkmThesis, VerticesOfAMesh) {
  BkmThesisSettings settings;
  settings.knot_layout = KnotLayout::vertices;
  const SolvedChannel channel =
      solve(settings, box_mesh(Vec3::Constant(-1.0), Vec3::Constant(1.0)));
  EXPECT_EQ(figure(channel, "boundary_knots"), 8);
}

}  // namespace
}  // namespace knotlight
