// Coefficients of a medium in the C colour channels that a path carries at once.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "scene/scene.h"

namespace knotlight {

// One value per channel of a scene with 1 or 3.
template <int C>
using Channels = Eigen::Array<double, C, 1>;

template <int C>
Channels<C> channels(const Spectrum& all) {
  return all.template head<C>();
}

template <int C>
struct Optics {
  Channels<C> sigma_s = Channels<C>::Zero();  // 1/length
  Channels<C> sigma_t = Channels<C>::Zero();  // 1/length
  Channels<C> g = Channels<C>::Zero();
  Channels<C> radiated = Channels<C>::Zero();  // E / (4 pi), W/(length^3 sr)
  double ior = 1.0;
  double alpha = 0.0;  // roughness of the surface (core/microfacet.h)
  bool emits = false;
  bool same_extinction = true;  // in all channels
  bool same_phase = true;
  bool holds_lights = false;  // point or area lights may lie inside
  bool holds_points = false;  // point lights do

  Optics() = default;
  explicit Optics(const TranslucentMaterial& m)
      : sigma_s(channels<C>(m.sigma_s)),
        sigma_t(channels<C>(m.sigma_a + m.sigma_s)),
        g(channels<C>(m.g)),
        radiated(channels<C>(m.emission) / (4.0 * std::numbers::pi)),
        ior(m.ior),
        alpha(m.alpha()),
        emits((radiated > 0.0).any()),
        same_extinction((sigma_t == sigma_t[0]).all()),
        same_phase((g == g[0]).all()) {}
};

}  // namespace knotlight
