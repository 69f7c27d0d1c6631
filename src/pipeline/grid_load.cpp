#include "pipeline/grid_load.h"

#include <algorithm>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// The weak form of docs/theory.md (12), tested with v: a first-interaction photon of power dPhi
// flying along w gives
//   3 sigma_s sigma_tr / (4 pi sigma_t) dPhi v  +  (3/4pi) g (sigma_s / sigma_t) dPhi w . grad v.
// The boundary term with Q_ri . n cancels against the one from div Q_ri: no density has to be
// estimated, anywhere. Where the ends of flights are known, the derivative goes too (13b): it is
// integrated along each flight, which leaves far less noise near the surface than dipoles.
void add_photons(GridLoad& load, const IncidentHalf& half, const Medium& m) {
  const double strength = 3.0 * m.sigma_s * m.sigma_tr() / (4.0 * pi * m.sigma_t());
  const double moment = 3.0 / (4.0 * pi) * m.g * m.sigma_s / m.sigma_t();
  for (std::size_t i = 0; i < half.expected; ++i)
    load.add_source(half.photons[i].position,
                    (strength + moment * m.sigma_t()) * half.photons[i].power);
  for (const FlightEnd& end : half.ends)
    load.add_source(end.position, end.normal, moment * m.sigma_t() * end.power);
  for (std::size_t i = half.expected; i < half.photons.size(); ++i) {
    const VolumePhoton& photon = half.photons[i];
    load.add_source(photon.position, strength * photon.power);
    if (moment != 0.0) load.add_dipole(photon.position, moment * photon.power * photon.direction);
  }
}

void add_irradiance_below(GridLoad& load, const IncidentHalf& half, const ChannelProblem& p) {
  for (const PointSource& source : sources_below(half.irradiance, p.medium, p.caster, p.object))
    load.add_source(source.position, source.strength);
}

// Boundary flux: what enters is diffuse at once, U + k dU/dn = ((1 + A) / 2) E' / pi [ABW11].
void add_irradiance_on_surface(GridLoad& load, const IncidentHalf& half, const ChannelProblem& p) {
  const auto n = static_cast<Eigen::Index>(half.irradiance.size());
  Points positions(3, n);
  Points normals(3, n);
  Eigen::VectorXd areas(n);
  Eigen::VectorXd g(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const IrradianceSample& sample = half.irradiance[static_cast<std::size_t>(i)];
    positions.col(i) = sample.surface.position;
    normals.col(i) = sample.surface.normal;
    areas[i] = sample.area;
    g[i] = p.coefficients.boundary_flux_data(sample.entered);
  }
  load.add_boundary_data(positions, normals, areas, g, p.coefficients.k);
}

}  // namespace

std::vector<PointSource> sources_below(const std::vector<IrradianceSample>& samples,
                                       const Medium& medium, const RayCaster& caster,
                                       std::uint32_t object) {
  const double depth = 1.0 / medium.sigma_tr();
  std::vector<PointSource> sources;
  for (const IrradianceSample& sample : samples) {
    if (sample.entered == 0.0) continue;
    const Ray inward{sample.surface.position, -sample.surface.normal, 2.0 * depth};
    const auto far_side = caster.nearest(inward, object);
    const double below = far_side ? 0.5 * far_side->t : depth;
    const double power = sample.entered * sample.area * medium.reduced_albedo();
    sources.push_back({sample.surface.position - below * sample.surface.normal,
                       3.0 * medium.sigma_tr() / (4.0 * pi) * power});
  }
  return sources;
}

GridLoad incident_load(const GridGeometry& geometry, const IncidentHalf& half,
                       const ChannelProblem& p) {
  GridLoad load(geometry);
  add_photons(load, half, p.medium);
  if (p.light.model == SourceModel::irradiance_sampling) add_irradiance_below(load, half, p);
  if (p.light.model == SourceModel::boundary_flux) add_irradiance_on_surface(load, half, p);
  load.add_uniform(p.coefficients.source_per_E * p.medium.emission);
  return load;
}

GridField unscattered_on_grid(const std::shared_ptr<const GridGeometry>& geometry,
                              const IncidentLight& light, const Medium& medium) {
  GridLoad load(*geometry);
  for (const IncidentHalf& half : light.halves)
    for (const VolumePhoton& photon : half.photons)
      load.add_source(photon.position, 0.5 * photon.power);
  // Interactions per volume = 4 pi sigma_t U_ri.
  Eigen::VectorXd values = load.values() / (4.0 * pi * medium.sigma_t());
  const Eigen::VectorXd volumes = node_weights(geometry->finest()).volume;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = volumes[i] > 0.0 ? values[i] / volumes[i] : 0.0;
  return {geometry, std::move(values)};
}

}  // namespace knotlight
