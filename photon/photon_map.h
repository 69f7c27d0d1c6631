// The volume photon map of one object in one channel: a kd-tree over photons (nanoflann, only in
// photon_map.cpp) and the density estimates that turn photons into U_ri and Q_ri.
#pragma once

#include <memory>
#include <vector>

#include "core/medium.h"
#include "photon/volume_photon.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Reduced incident light at a point.
struct ReducedIncident {
  double U_ri = 0.0;         // mean intensity, W/(length^2 sr)
  Vec3 Q_ri = Vec3::Zero();  // flux moment g sigma_s F_ri, W/length^3
  // Of U_ri, from the number and powers of the photons in the ball; infinite if the map has photons
  // but none in the ball, 0 for an empty map (no light: U_ri = 0 is exact).
  double relative_standard_error = 0.0;
};

struct EstimateOptions {
  // Photons that set the ball's radius, unless max_radius is smaller; > 1. Not used by
  // DensityEstimator::radius.
  std::size_t nearest = 200;
  double max_radius = 0.25;  // in mean free paths 1/sigma_t
  // Light on its first flight falls off along its direction by a known factor, so each
  // first-interaction photon is carried along its ray to the plane through x: its weight is
  // exp(sigma_t w.(p - x)). Without it a half-ball on a lit surface is 3/8 sigma_t r too dark. Has
  // no effect on a map of all orders.
  bool undo_attenuation = true;
  // nearest: all photons of the ball count alike. radius: the same, the ball always of max_radius.
  // kernel: a smooth kernel over the ball of `nearest`.
  DensityEstimator estimator = DensityEstimator::nearest;
  // With undo_attenuation: photons that come in beams (beams.h) are not carried; their fall-off
  // across the ball, curved surface and spreading rays included, is part of what the estimate
  // divides by.
  bool beams = true;
  // The other photons' density may have a slope that their own rays do not tell: fit it and carry
  // the photons along it too (slope_fit.h). Takes the bias of slanted light at the surface away,
  // for up to twice the noise there.
  bool fit_slope = true;
};

// What docs/results/estimators.md found best for a map of this many photons: 2 sqrt(photons) of
// them in a ball of at most one mean free path, half of one in a refracting object (ior).
EstimateOptions default_estimate(std::size_t photons, double ior = 1.0);

class VolumePhotonMap {
 public:
  // Keeps the photons of order 1, or all of them (the estimates are then of U = U_ri + U_d). The
  // medium gives sigma_t, g, sigma_s.
  VolumePhotonMap(std::vector<VolumePhoton> photons, const Medium& medium,
                  bool first_order_only = true);
  ~VolumePhotonMap();
  VolumePhotonMap(VolumePhotonMap&&) noexcept;
  VolumePhotonMap& operator=(VolumePhotonMap&&) noexcept;

  std::size_t size() const;
  const std::vector<VolumePhoton>& photons() const;
  double total_power() const;  // W

  // U_ri and Q_ri at x, inside the object or on its surface, from the nearest photons:
  //   U_ri = (1/4pi) (1/sigma_t) sum dPhi / V,  Q_ri = g (sigma_s/sigma_t) sum dPhi w / V,
  // V = the part of the ball that lies inside the object ([V09 6.19-6.20], corrected:
  // docs/theory.md); with a kernel, V = its mass there and each photon has the kernel's weight. The
  // ball reaches to the k-th nearest photon and counts the k - 1 before it, which makes the density
  // unbiased; or to max_radius, whichever is nearer.
  ReducedIncident estimate(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
                           std::uint32_t object) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace knotlight
