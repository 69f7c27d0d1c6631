// Solving for the asymptotic part of the field of scattered light instead of P1's: the same
// equation for another medium, and sources that count for less near the surface.
#pragma once

#include <optional>

#include "core/asymptotic.h"
#include "core/surface_layer.h"
#include "pipeline/incident_light.h"
#include "scene/scene.h"

namespace knotlight {

inline bool solves_beyond_p1(const SolverSettings& settings) {
  return settings.diffusion.value_or(Diffusion::p1) != Diffusion::p1;
}

// What is solved for one object in one channel.
struct Equation {
  Medium medium;
  DiffusionCoefficients coefficients;
  std::optional<PointSourceField> beyond_p1;  // empty: the P1 equation of the object's own medium
};

// By solver.diffusion. P1 where it is asked for or left out, where scattering is not isotropic, and
// for source models that do not tell where light is scattered first. surface: null for P1.
Equation equation_for(const Scene& scene, std::uint32_t object, int channel, SourceModel source,
                      const FeltSurface* surface);

// Multiplies the power of the photons by asymptotic_power and by the layer weight of their depth;
// nothing with P1. medium: the object's own.
void weigh_sources(IncidentLight& light, const Medium& medium, const Equation& equation,
                   const FeltSurface& surface);

// Of an object; curvature over a transport mean free path of its densest channel.
FeltSurface felt_surface(const Object& object, int channels);

}  // namespace knotlight
