// Photons of all orders against the transfer equation, and P1 against it.
#include <fmt/format.h>

#include <cmath>

#include "photon/photon_tracer.h"
#include "reference/slab_p1.h"
#include "validate/parts.h"

namespace knotlight {
namespace {

// What stands for the half-space: thicker, 1e-7 of the light reaches the far side.
constexpr double deep_enough = 30.0;  // mean free paths

constexpr double margin = 6.0;  // between hole and sides, thicknesses
constexpr double gap = 0.5;     // between the slab and the screens, thicknesses

Object black_quad(const std::string& name, const Vec3& center, const Vec3& u, const Vec3& v) {
  return {name, quad_mesh(center, u, v), DiffuseMaterial{Spectrum::Zero()}};
}

// The slab, a black screen with a square hole before it and a black wall behind it. Light enters
// through the hole alone, far enough from the box's sides that what leaves there does not count;
// what the wall takes has been transmitted.
Scene slab_behind_screen(const Medium& medium, double thickness) {
  const double hole = margin * thickness;
  const double w = hole + margin * thickness;
  Scene scene = scene_of(box_mesh({-w, -w, 0.0}, {w, w, thickness}), medium,
                         {DirectionalLight{Vec3::UnitZ(), Spectrum::Ones()}});
  const double reach = 2.0 * w;  // past the sphere around the slab, which is what is aimed at
  const double front = -gap * thickness;
  const double bar = 0.5 * (reach - hole), middle = hole + bar;
  scene.objects.push_back(black_quad("wall", {0.0, 0.0, (1.0 + gap) * thickness},
                                     reach * Vec3::UnitX(), reach * Vec3::UnitY()));
  for (const double side : {-1.0, 1.0}) {
    scene.objects.push_back(black_quad("screen", {side * middle, 0.0, front}, bar * Vec3::UnitX(),
                                       reach * Vec3::UnitY()));
    scene.objects.push_back(black_quad("screen", {0.0, side * middle, front}, hole * Vec3::UnitX(),
                                       bar * Vec3::UnitY()));
  }
  return scene;
}

ValidationRow within_noise(const std::string& quantity, double value, double reference,
                           double standard_error, double digit) {
  return {quantity,
          value,
          reference,
          std::abs(value - reference),
          standard_errors_allowed * standard_error + 0.5 * digit,
          fmt::format("{} standard errors of {:.1e} + half a digit of the table",
                      standard_errors_allowed, standard_error)};
}

}  // namespace

void run_exact_slab(const ExactSlab& slab, std::size_t photons, const CaseRun& run,
                    ValidatedCase& result) {
  const bool half_space = std::isinf(slab.optical_thickness);
  const Medium medium = medium_of(1.0, slab.albedo, slab.g, slab.ior);
  const PreparedScene prepared =
      prepare_scene(slab_behind_screen(medium, half_space ? deep_enough : slab.optical_thickness));
  TracerOptions options;
  options.photons = photons;
  options.seed = run.seed;
  options.orders = TracerOptions::Orders::all;
  options.store = false;
  Stages stages(false);
  Stage stage(stages, "photons", photons);
  const TraceResult traced =
      trace_photons(prepared.scene, *prepared.caster, 0, options, Workers(1), stage);
  const EnergyAudit& body = traced.audit[0];
  const EnergyAudit& wall = traced.audit[1];

  const double T = wall.incident / body.incident;
  const double T_error = wall.standard_error_incident / body.incident;
  const double R = (body.reflected + body.escaped) / body.incident - T;
  // Errors of sums bounded by the sum of errors: the parts are not independent.
  const double R_error =
      (body.standard_error_reflected + body.standard_error_escaped) / body.incident +
      (half_space ? 0.0 : T_error);
  result.rows.push_back(within_noise("R by photons, absolute", R, slab.R, R_error, slab.digit));
  if (!half_space)
    result.rows.push_back(within_noise("T by photons, absolute", T, slab.T, T_error, slab.digit));
  result.rows.push_back(
      {"incident - reflected - absorbed - escaped",
       (body.reflected + body.absorbed + body.escaped) / body.incident, 1.0,
       std::abs(body.reflected + body.absorbed + body.escaped - body.incident) / body.incident,
       1e-5, "photons dropped because of rounding at edges"});
}

void run_model_error(const CaseRun&, ValidatedCase& result) {
  for (const ExactSlab& s : diffusive_slabs()) {
    const SlabP1 slab(medium_of(s.optical_thickness, s.albedo, s.g, s.ior), Boundary::marshak, 1.0);
    const std::string where =
        fmt::format("n {}, albedo {}, b {}, g {}", s.ior, s.albedo, s.optical_thickness, s.g);
    for (const auto& [name, p1, exact] :
         {std::tuple{"R", slab.reflected(), s.R}, {"T", slab.transmitted(), s.T}}) {
      ValidationRow row = relative_row(fmt::format("{}: {}", name, where), p1, exact, 0.0,
                                       "diffusion against transport: the model's own error");
      row.judged = false;
      result.rows.push_back(row);
    }
  }
}

}  // namespace knotlight
