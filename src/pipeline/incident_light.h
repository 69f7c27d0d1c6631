// The light that arrives at an object from outside, in the form its source model wants, as two
// independent estimates: the solution is the mean of what both give, half their difference is its
// noise.
#pragma once

#include <array>
#include <vector>

#include "photon/first_light_tracer.h"
#include "photon/irradiance.h"
#include "photon/photon_map.h"
#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"

namespace knotlight {

struct IncidentHalf {
  // First interactions; with every model that part of the light that was scattered before it
  // entered. The first `expected` of them come from trace_first_light, with the ends of their
  // flights; the others from random walks.
  std::vector<VolumePhoton> photons;
  std::size_t expected = 0;
  std::vector<FlightEnd> ends;
  std::vector<IrradianceSample> irradiance;  // of the models without volume photons
};

struct IncidentLight {
  SourceModel model = SourceModel::photon_map;
  bool has_walks = false;              // some of the photons are random walks, or all
  std::array<IncidentHalf, 2> halves;  // each an estimate of all the light

  std::size_t photons() const { return halves[0].photons.size() + halves[1].photons.size(); }
  double photon_power() const;      // W, interacting for the first time
  std::size_t lit_samples() const;  // irradiance samples that any light reaches
  double entered_power() const;     // W, by the irradiance samples
};

// How the scene wants densities estimated in a map of so many photons of a medium.
EstimateOptions estimate_options(const SolverSettings& settings, std::size_t photons,
                                 const Medium& medium);

// One entry per translucent object (PreparedScene::translucent). Advances the stage by
// incident_light_work.
std::vector<IncidentLight> trace_incident_light(const PreparedScene& prepared, int channel,
                                                SourceModel model, std::uint64_t seed,
                                                const Workers& workers, Stage& stage);
std::size_t incident_light_work(const PreparedScene& prepared, SourceModel model);

// Whether light that has left an object can enter it, or another one, again: always unless there is
// but one, convex, and no diffuse object reflects.
bool light_can_come_back(const PreparedScene& prepared);

}  // namespace knotlight
