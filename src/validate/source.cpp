// Estimates from the photon map at points of a slab, before any equation is solved: U_ri, f and the
// Robin data that the boundary knot method starts from.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "photon/source_terms.h"
#include "pipeline/incident_light.h"
#include "reference/slab_p1.h"
#include "validate/parts.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double slab_half_width = 2.0;  // thicknesses; light in a beam does not spread
constexpr double central_part = 1.5;     // points stay clear of the edges, whose balls are cut
constexpr int estimates_per_depth = 200;
// 200 photons scatter by 7 %, their mean over 200 points by 0.5 %, were the photons independent.
// Low-discrepancy rays lie in layers that all points of one depth see alike: up to 2.5 % from seed
// to seed. A wrong factor is off by 20 % or more.
constexpr double allowed = 0.05;

Points points_at(double z) {
  Points points(3, estimates_per_depth);
  for (int i = 0; i < estimates_per_depth; ++i) {
    const double r = central_part * std::sqrt((i + 0.5) / estimates_per_depth);
    const double phi = i * pi * (3.0 - std::sqrt(5.0));
    points.col(i) = Vec3(r * std::cos(phi), r * std::sin(phi), z);
  }
  return points;
}

}  // namespace

void run_source_terms(const Medium& medium, std::size_t photons, const CaseRun& run,
                      ValidatedCase& result) {
  Scene scene = scene_of(
      box_mesh({-slab_half_width, -slab_half_width, 0.0}, {slab_half_width, slab_half_width, 1.0}),
      medium, {DirectionalLight{Vec3::UnitZ(), Spectrum::Ones()}});
  scene.solver.photons = photons;
  const PreparedScene prepared = prepare_scene(std::move(scene));
  const Workers workers(1);
  Stages stages(false);
  Stage stage(stages, "photons", incident_light_work(prepared, SourceModel::photon_map));
  std::vector<IncidentLight> light =
      trace_incident_light(prepared, 0, SourceModel::photon_map, run.seed, workers, stage);
  const VolumePhotonMap map(std::move(light[0].halves[0].photons), medium);

  SourceTermOptions options;
  options.boundary = Boundary::marshak;
  const SlabP1 slab(medium, Boundary::marshak, 1.0);
  const P1Constants c = p1_constants(medium, Boundary::marshak);
  const std::string why = "200 photons a point, mean over 200 points";
  const auto add_depth = [&](const std::string& place, double z, const Vec3& normal) {
    const Points at = points_at(z);
    const Points normals = normal.replicate(1, at.cols());
    const SourceTerms terms =
        source_terms(at, normals, Points(3, 0), map, medium, options, *prepared.caster, 0, workers);
    result.rows.push_back(
        relative_row("U_ri, " + place, terms.U_ri.mean(), slab.U_ri(z), allowed, why));
    result.rows.push_back(
        relative_row("f, " + place, terms.f.mean(), c.per_U_ri * slab.U_ri(z), allowed, why));
    if (medium.g != 0.0)
      result.rows.push_back(relative_row("Robin data, " + place, terms.g.mean(),
                                         c.per_Q * normal.z() * slab.Q_ri_z(z), allowed, why));
  };
  add_depth("lit face", 0.0, -Vec3::UnitZ());
  // Any plane inside may stand for a boundary: Q_ri . n along the beam.
  add_depth("one mean free path deep", 1.0 / medium.sigma_t(), Vec3::UnitZ());
}

}  // namespace knotlight
