// Slabs: a box so wide that its middle does not know of its edges.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "reference/slab_p1.h"
#include "validate/parts.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr int depths = 21;
// The field does not depend on x and y; averaging over a disc takes the photons' noise and the
// place of the grid's cells out.
constexpr int points_per_depth = 64;
constexpr double disc_radius = 0.3;  // thicknesses

// The report's leaving flux of a whole box is sampled at 4096 points, whose scatter its standard
// error does not know.
constexpr double leaving_sampled = 0.005;

// What the box's sides may take from the field in its middle, of what is allowed there.
constexpr double edge_share = 0.2;

// The field's slowest lateral mode between extrapolated faces falls off as
// exp(-sqrt(lambda^2 + (pi / (1 + 2 k))^2) x); there are four sides.
double half_width(const Medium& medium, const CaseSolver& solver) {
  const P1Constants c = p1_constants(medium, solver.boundary);
  const double rate = std::hypot(c.lambda, pi / (1.0 + 2.0 * c.k));
  return disc_radius + std::log(4.0 / (edge_share * solver.allowed)) / rate;
}

Scene slab_scene(const Medium& medium, const CaseSolver& solver) {
  const double w = half_width(medium, solver);
  return scene_of(box_mesh({-w, -w, 0.0}, {w, w, 1.0}), medium,
                  {DirectionalLight{Vec3::UnitZ(), Spectrum::Ones()}});
}

// U at the depth z, mean over a sunflower of points around the axis.
double mean_U(const SolvedChannel& channel, double z) {
  Points points(3, points_per_depth);
  for (int i = 0; i < points_per_depth; ++i) {
    const double r = disc_radius * std::sqrt((i + 0.5) / points_per_depth);
    const double phi = i * pi * (3.0 - std::sqrt(5.0));
    points.col(i) = Vec3(r * std::cos(phi), r * std::sin(phi), z);
  }
  return channel.U_d(points).mean();
}

// Rows and the curve of U over z; exact(z) is its closed form.
template <class Exact>
void depth_rows(const SolvedChannel& channel, const CaseSolver& solver, const char* symbol,
                const Exact& exact, ValidatedCase& result) {
  ValidationCurve curve{"z / thickness", fmt::format("{}, W/(mm² sr)", symbol), {}, {}, {}};
  for (int i = 0; i < depths; ++i) {
    const double z = static_cast<double>(i) / (depths - 1);
    curve.x.push_back(z);
    curve.value.push_back(mean_U(channel, z));
    curve.reference.push_back(exact(z));
  }
  const std::string why = grid_reason(solver);
  for (const auto& [place, i] :
       {std::pair{"lit face", 0}, {"middle", depths / 2}, {"far face", depths - 1}})
    result.rows.push_back(relative_row(fmt::format("{}, {}", symbol, place),
                                       curve.value[static_cast<std::size_t>(i)],
                                       curve.reference[static_cast<std::size_t>(i)],
                                       i == 0 ? solver.allowed_where_lit() : solver.allowed, why));
  result.rows.push_back(l2_row(fmt::format("{}(z), relative L2", symbol),
                               Eigen::Map<const Eigen::VectorXd>(curve.value.data(), depths),
                               Eigen::Map<const Eigen::VectorXd>(curve.reference.data(), depths),
                               solver.allowed, why));
  result.curves.push_back(std::move(curve));
}

}  // namespace

void run_slab(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
              ValidatedCase& result) {
  const SolvedScene solved = solve_case(slab_scene(medium, solver), solver, run);
  const SlabP1 slab(medium, solver.boundary, 1.0);
  const SolvedChannel& channel = solved.objects[0][0];
  depth_rows(
      channel, solver, "U_d", [&](double z) { return slab.U_d(z); }, result);
  const DiffusionCoefficients c = diffusion_coefficients(medium, solver.boundary);
  const std::string why = grid_reason(solver);
  // Without the light that was never scattered, which is the same on both sides.
  result.rows.push_back(relative_row("R, diffuse part", c.leaving_flux(mean_U(channel, 0.0)),
                                     slab.diffusely_reflected(), solver.allowed_where_lit(), why));
  result.rows.push_back(relative_row("T, diffuse part", c.leaving_flux(mean_U(channel, 1.0)),
                                     slab.diffusely_transmitted(), solver.allowed, why));
  result.rows.push_back(energy_balance(channel.report, leaving_sampled + solver.allowed));
}

// The beam enters as if it were diffuse at once; only its refracted irradiance counts.
void run_diffuse_slab(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                      ValidatedCase& result) {
  Scene scene = slab_scene(medium, solver);
  // Irradiance is sampled in strata made of whole triangles: small ones make them compact.
  Shape& shape = scene.objects[0].shape;
  shape = refine(std::get<TriangleMesh>(shape), solver.cell / medium.sigma_tr());
  scene.solver.source = SourceModel::boundary_flux;
  scene.solver.irradiance_samples = solver.photons;
  const SolvedScene solved = solve_case(std::move(scene), solver, run);
  const DiffuseSlabP1 slab(medium, solver.boundary, 1.0);
  const double entered = 1.0 - reflectance_from_inside(0.0, medium.ior);
  const SolvedChannel& channel = solved.objects[0][0];
  depth_rows(
      channel, solver, "U", [&](double z) { return entered * slab.U(z); }, result);
  const DiffusionCoefficients c = diffusion_coefficients(medium, solver.boundary);
  const std::string why = grid_reason(solver);
  const double U_ri = DiffusionCoefficients::boundary_flux_U_ri(entered);
  result.rows.push_back(relative_row("R, diffuse part", c.leaving_flux(mean_U(channel, 0.0) - U_ri),
                                     entered * slab.reflected(), solver.allowed_where_lit(), why));
  result.rows.push_back(relative_row("T", c.leaving_flux(mean_U(channel, 1.0)),
                                     entered * slab.transmitted(), solver.allowed, why));
  result.rows.push_back(energy_balance(channel.report, leaving_sampled + solver.allowed));
}

}  // namespace knotlight
