// The volume photon map of one object in one channel: a kd-tree over photons (nanoflann, only in
// photon_map.cpp) and the density estimates that turn photons into U_ri and Q_ri.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/medium.h"
#include "photon/volume_photon.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Reduced incident light at a point.
struct ReducedIncident {
  double U_ri = 0.0;                     // mean intensity, W/(length^2 sr)
  Vec3 Q_ri = Vec3::Zero();              // flux moment g sigma_s F_ri, W/length^3
  double relative_standard_error = 0.0;  // of U_ri, from the photon count
};

struct EstimateOptions {
  std::size_t nearest = 200;  // photons in the ball, unless max_radius is smaller
  double max_radius = 0.25;   // in mean free paths 1/sigma_t
};

class VolumePhotonMap {
 public:
  // Keeps the photons of order `first_order_only` ? 1 : any. The medium gives sigma_t, g, sigma_s.
  VolumePhotonMap(std::vector<VolumePhoton> photons, const Medium& medium);
  ~VolumePhotonMap();
  VolumePhotonMap(VolumePhotonMap&&) noexcept;
  VolumePhotonMap& operator=(VolumePhotonMap&&) noexcept;

  std::size_t size() const;
  const std::vector<VolumePhoton>& photons() const;
  double total_power() const;  // W

  // U_ri and Q_ri at x from the nearest first-interaction photons:
  //   U_ri = (1/4pi) (1/sigma_t) sum dPhi / V,  Q_ri = g (sigma_s/sigma_t) sum dPhi w / V,
  // V = the part of the ball that lies inside the object [physics: V09 6.19-6.20, corrected].
  ReducedIncident estimate(const Vec3& x, const EstimateOptions& options, const RayCaster& caster,
                           std::uint32_t object) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Volume of the part of the ball around x (inside or on the surface) that lies inside the object,
// summed over a fixed spherical design of rays; exact where the surface is further than r. Unit
// length^3.
double ball_volume_inside(const Vec3& x, double r, const RayCaster& caster, std::uint32_t object);

}  // namespace knotlight
