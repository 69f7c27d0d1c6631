// Balls of radius 1 around the origin.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "reference/ball_p1.h"
#include "reference/sphere_beam_p1.h"
#include "validate/parts.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr int rings = 17;   // of surface points, equal steps in z: equal areas
constexpr int around = 24;  // points on each
constexpr int radii = 15;
// Around a lamp U_d is singular (a logarithm, or 1/r) and the grid's is not: judged from here on.
constexpr double nearest_to_lamp = 0.3;

Vec3 on_ring(double z, int i) {
  const double phi = 2.0 * pi * (i + 0.3) / around;
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Points ring(double z) {
  Points points(3, around);
  for (int i = 0; i < around; ++i) points.col(i) = on_ring(z, i);
  return points;
}

// U_d at the distance r from the centre: mean over points spread over that sphere.
double mean_at_radius(const SolvedChannel& channel, double r) {
  constexpr int count = 48;
  Points points(3, count);
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double phi = i * pi * (3.0 - std::sqrt(5.0));
    const double across = std::sqrt(1.0 - z * z);
    points.col(i) = r * Vec3(across * std::cos(phi), across * std::sin(phi), z);
  }
  return channel.U_d(points).mean();
}

// Rows of a field that depends on r alone.
template <class Ball>
void radius_rows(const SolvedChannel& channel, const CaseSolver& solver, const Ball& ball,
                 double smallest, ValidatedCase& result) {
  ValidationCurve curve{"r / radius", "U_d, W/(mm² sr)", {}, {}, {}};
  for (int i = 0; i < radii; ++i) {
    const double r = smallest + (1.0 - smallest) * i / (radii - 1);
    curve.x.push_back(r);
    curve.value.push_back(mean_at_radius(channel, r));
    curve.reference.push_back(ball.U_d(r));
  }
  const std::string why = grid_reason(solver);
  result.rows.push_back(relative_row(fmt::format("U_d, r = {}", smallest), curve.value.front(),
                                     curve.reference.front(), solver.allowed, why));
  result.rows.push_back(relative_row("U_d, surface", curve.value.back(), curve.reference.back(),
                                     solver.allowed, why));
  result.rows.push_back(l2_row(
      "U_d(r), relative L2", Eigen::Map<const Eigen::VectorXd>(curve.value.data(), radii),
      Eigen::Map<const Eigen::VectorXd>(curve.reference.data(), radii), solver.allowed, why));
  result.rows.push_back(relative_row("power leaving, W", channel.report.power_leaving,
                                     ball.power_leaving(), solver.allowed, why));
  result.rows.push_back(energy_balance(channel.report, solver.allowed));
  result.curves.push_back(std::move(curve));
}

}  // namespace

void run_ball_under_beam(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                         ValidatedCase& result) {
  const SolvedScene solved =
      solve_case(scene_of(Sphere{}, medium, {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}}),
                 solver, run);
  const SolvedChannel& channel = solved.objects[0][0];
  const SphereBeamP1 ball(medium, solver.boundary, 1.0);
  ValidationCurve curve{"z / radius, on the surface", "U_d, W/(mm² sr)", {}, {}, {}};
  Eigen::VectorXd value(rings * around), reference(rings * around);
  for (int i = 0; i < rings; ++i) {
    const double z = (2.0 * i + 1.0) / rings - 1.0;
    const double exact = ball.U_d(on_ring(z, 0));
    value.segment(i * around, around) = channel.U_d(ring(z));
    reference.segment(i * around, around).setConstant(exact);
    curve.x.push_back(z);
    curve.value.push_back(value.segment(i * around, around).mean());
    curve.reference.push_back(exact);
  }
  const std::string why = grid_reason(solver);
  result.rows.push_back(
      l2_row("U_d on the surface, relative L2", value, reference, solver.allowed, why));
  result.rows.push_back(relative_row("U_d, lit pole", channel.U_d_at(Vec3::UnitZ()),
                                     ball.U_d(Vec3::UnitZ()), solver.allowed_where_lit(), why));
  result.rows.push_back(relative_row("U_d, centre", channel.U_d_at(Vec3::Zero()),
                                     ball.U_d(Vec3::Zero()), solver.allowed, why));
  result.rows.push_back(relative_row("power in, W", channel.report.power_in,
                                     medium.albedo() * ball.power_in(), solver.allowed, why));
  result.rows.push_back(relative_row("power leaving, W", channel.report.power_leaving,
                                     ball.power_leaving(), solver.allowed, why));
  result.rows.push_back(energy_balance(channel.report, solver.allowed));
  result.curves.push_back(std::move(curve));
}

void run_lamp_in_ball(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                      ValidatedCase& result) {
  const Spectrum one_watt = Spectrum::Constant(1.0 / (4.0 * pi));
  const SolvedScene solved =
      solve_case(scene_of(Sphere{}, medium, {PointLight{Vec3::Zero(), one_watt}}), solver, run);
  radius_rows(solved.objects[0][0], solver, LampInBallP1(medium, solver.boundary, 1.0),
              nearest_to_lamp, result);
}

void run_glowing_ball(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                      ValidatedCase& result) {
  const SolvedScene solved = solve_case(scene_of(Sphere{}, medium, {}), solver, run);
  radius_rows(solved.objects[0][0], solver, GlowingBallP1(medium, solver.boundary, 1.0), 0.0,
              result);
}

}  // namespace knotlight
