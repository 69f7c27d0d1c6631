#include "pipeline/incident_light.h"

#include <algorithm>
#include <cmath>

#include "core/convexity.h"
#include "photon/photon_tracer.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

// Light that comes back is a smaller and smoother part of the source than the first light, so a
// quarter as many paths carry it with as little noise.
constexpr double returning_share = 0.25;

// Irradiance samples per square of a transport mean free path. Point sources below the surface have
// the mean free path between them and the surface to even out; sources on the surface do not.
constexpr double samples_below = 60.0;
constexpr double samples_on = 400.0;
// Rays per sample to lights of some extent: where samples are few each has to be good.
constexpr int rays_below = 8;
constexpr int rays_on = 1;
constexpr double fewest_samples = 5e3, most_samples = 2e6;

std::size_t sample_count(const Scene& scene, std::uint32_t object, int channel, SourceModel model) {
  if (scene.solver.irradiance_samples) return *scene.solver.irradiance_samples;
  const double sigma_tr = scene.objects[object].translucent()->medium(channel).sigma_tr();
  const double squares = surface_area(scene.objects[object].shape) * sigma_tr * sigma_tr;
  return static_cast<std::size_t>(
      std::clamp((model == SourceModel::boundary_flux ? samples_on : samples_below) * squares,
                 fewest_samples, most_samples));
}

// One trace as two halves, the photons stored first and those stored last. Each half is an estimate
// of all the light, so its photons carry twice their power.
void append_split(std::array<IncidentHalf, 2>& halves, std::vector<VolumePhoton> photons) {
  for (VolumePhoton& photon : photons) photon.power *= 2.0;
  const auto middle = photons.begin() + static_cast<std::ptrdiff_t>(photons.size() / 2);
  halves[0].photons.insert(halves[0].photons.end(), photons.begin(), middle);
  halves[1].photons.insert(halves[1].photons.end(), middle, photons.end());
}

bool follows_returning_light(const PreparedScene& prepared) {
  const SolverSettings& settings = prepared.scene.solver;
  return settings.returning_light.value_or(settings.boundary == Boundary::milne) &&
         light_can_come_back(prepared);
}

std::size_t returning_photons(const PreparedScene& prepared) {
  if (!follows_returning_light(prepared)) return 0;
  return std::max<std::size_t>(
      1, std::llround(returning_share * static_cast<double>(prepared.scene.solver.photons)));
}

bool by_collisions(const SolverSettings& settings) {
  return settings.deposits == Deposits::collisions;
}

}  // namespace

double IncidentLight::photon_power() const {
  double sum = 0.0;
  for (const IncidentHalf& half : halves)
    for (const VolumePhoton& photon : half.photons) sum += 0.5 * photon.power;
  return sum;
}

std::size_t IncidentLight::lit_samples() const {
  std::size_t lit = 0;
  for (const IncidentHalf& half : halves)
    for (const IrradianceSample& sample : half.irradiance) lit += sample.entered > 0.0;
  return lit;
}

double IncidentLight::entered_power() const {
  double sum = 0.0;
  for (const IncidentHalf& half : halves)
    for (const IrradianceSample& sample : half.irradiance)
      sum += 0.5 * sample.entered * sample.area;
  return sum;
}

EstimateOptions estimate_options(const SolverSettings& settings, std::size_t photons,
                                 const Medium& medium) {
  EstimateOptions options = default_estimate(photons, medium.ior);
  options.estimator = settings.estimator;
  if (settings.estimate_photons) options.nearest = *settings.estimate_photons;
  if (settings.estimate_radius) options.max_radius = *settings.estimate_radius;
  return options;
}

bool light_can_come_back(const PreparedScene& prepared) {
  if (prepared.translucent.size() != 1) return prepared.translucent.size() > 1;
  return surroundings_reflect(prepared.scene) ||
         !is_convex(prepared.scene.objects[prepared.translucent[0]].shape);
}

std::size_t incident_light_work(const PreparedScene& prepared, SourceModel model) {
  const bool photons = model == SourceModel::photon_map;
  if (photons && by_collisions(prepared.scene.solver)) return prepared.scene.solver.photons;
  return (photons ? prepared.scene.solver.photons : 0) + returning_photons(prepared);
}

std::vector<IncidentLight> trace_incident_light(const PreparedScene& prepared, int channel,
                                                SourceModel model, std::uint64_t seed,
                                                const Workers& workers, Stage& stage) {
  const Scene& scene = prepared.scene;
  std::vector<IncidentLight> result(prepared.translucent.size());
  for (IncidentLight& light : result) {
    light.model = model;
    light.has_walks = follows_returning_light(prepared);
  }
  TracerOptions walk;
  walk.seed = seed;

  if (model == SourceModel::photon_map && by_collisions(scene.solver)) {
    walk.photons = scene.solver.photons;
    if (follows_returning_light(prepared)) walk.orders = TracerOptions::Orders::reentering;
    TraceResult traced = trace_photons(scene, *prepared.caster, channel, walk, workers, stage);
    for (std::size_t i = 0; i < result.size(); ++i)
      append_split(result[i].halves, std::move(traced.photons[prepared.translucent[i]]));
    return result;
  }

  for (std::size_t half = 0; half < 2; ++half) {
    if (model == SourceModel::photon_map) {
      FirstLightOptions rays;
      rays.rays = std::max<std::size_t>(1, scene.solver.photons / 2);
      rays.seed = seed;
      rays.replicate = half;
      FirstLight traced = trace_first_light(scene, *prepared.caster, channel, rays, workers, stage);
      for (std::size_t i = 0; i < result.size(); ++i) {
        IncidentHalf& light = result[i].halves[half];
        light.photons = std::move(traced.photons[prepared.translucent[i]]);
        light.ends = std::move(traced.ends[prepared.translucent[i]]);
        light.expected = light.photons.size();
      }
    } else {
      for (std::size_t i = 0; i < result.size(); ++i) {
        const std::uint32_t object = prepared.translucent[i];
        result[i].halves[half].irradiance = sample_irradiances(
            scene, *prepared.caster, channel, object,
            std::max<std::size_t>(1, sample_count(scene, object, channel, model) / 2),
            model == SourceModel::boundary_flux ? rays_on : rays_below, seed, 2 * object + half,
            workers);
      }
    }
  }
  if (follows_returning_light(prepared)) {
    walk.photons = returning_photons(prepared);
    walk.orders = TracerOptions::Orders::returned;
    TraceResult traced = trace_photons(scene, *prepared.caster, channel, walk, workers, stage);
    for (std::size_t i = 0; i < result.size(); ++i)
      append_split(result[i].halves, std::move(traced.photons[prepared.translucent[i]]));
  }
  return result;
}

}  // namespace knotlight
