#include "pipeline/beyond_p1.h"

#include <algorithm>

namespace knotlight {

Equation equation_for(const Scene& scene, std::uint32_t object, int channel, SourceModel source,
                      const FeltSurface* surface) {
  const SolverSettings& settings = scene.solver;
  const Medium own = scene.objects[object].translucent()->medium(channel);
  Equation equation{own, diffusion_coefficients(own, settings.boundary), std::nullopt};
  if (!solves_beyond_p1(settings) || own.g != 0.0 || source != SourceModel::photon_map ||
      surface == nullptr)
    return equation;
  equation.beyond_p1 = *settings.diffusion == Diffusion::grosjean
                           ? PointSourceField::grosjean(own.albedo())
                           : PointSourceField::exact(own.albedo());
  equation.medium = asymptotic_medium(own, *equation.beyond_p1);
  DiffusionCoefficients& c = equation.coefficients;
  c = diffusion_coefficients(equation.medium, settings.boundary);
  const double k =
      settings.boundary == Boundary::milne ? surface->layer.extrapolation() : c.k * own.sigma_t();
  const double bent =
      bent_extrapolation(k, surface->curvature.median() / own.sigma_t()) / own.sigma_t();
  c.A *= bent / c.k;  // the flux through the surface follows
  c.k = bent;
  return equation;
}

void weigh_sources(IncidentLight& light, const Medium& medium, const Equation& equation,
                   const FeltSurface& surface) {
  if (!equation.beyond_p1) return;
  const double power = asymptotic_power(medium, *equation.beyond_p1);
  const double sigma_t = medium.sigma_t();
  for (IncidentHalf& half : light.halves)
    for (VolumePhoton& photon : half.photons)
      photon.power *=
          power *
          surface.layer.weight(
              photon.depth * sigma_t, equation.coefficients.k * sigma_t,
              (surface.curvature.at(photon.surface) - surface.curvature.median()) / sigma_t);
}

FeltSurface felt_surface(const Object& object, int channels) {
  double sigma_tr = 0.0;
  for (int c = 0; c < channels; ++c)
    sigma_tr = std::max(sigma_tr, object.translucent()->medium(c).sigma_tr());
  return {SurfaceCurvature(object.shape, 1.0 / sigma_tr), SurfaceLayer(object.translucent()->ior)};
}

}  // namespace knotlight
