#include "trace/light_sample.h"

#include <limits>

namespace knotlight {
namespace {

constexpr double at_infinity = std::numeric_limits<double>::infinity();

struct Sampler {
  const Vec3& position;
  Rng& rng;

  std::optional<LightSample> operator()(const PointLight& light) const {
    const Vec3 to_light = light.position - position;
    const double square = to_light.squaredNorm();
    const double distance = std::sqrt(square);
    return LightSample{to_light / distance, distance, light.intensity / square};
  }

  std::optional<LightSample> operator()(const DirectionalLight& light) const {
    return LightSample{-light.direction, at_infinity, light.irradiance};
  }

  std::optional<LightSample> operator()(const AreaLight& light) const {
    const double s = 2.0 * rng.uniform() - 1.0;
    const double t = 2.0 * rng.uniform() - 1.0;
    const Vec3 to_light = light.center + s * light.u + t * light.v - position;
    const double square = to_light.squaredNorm();
    const double distance = std::sqrt(square);
    const Vec3 w = to_light / distance;
    const double cosine_light = -light.normal().dot(w);
    if (cosine_light <= 0.0) return std::nullopt;
    return LightSample{w, distance, light.radiance * (light.area() * cosine_light / square)};
  }

  std::optional<LightSample> operator()(const EnvironmentLight& light) const {
    if (light.map == nullptr) return std::nullopt;
    const double u = rng.uniform();
    const EnvironmentMap::Sample sample = light.map->sample(u, rng.uniform());
    return LightSample{sample.direction, at_infinity,
                       light.radiance * light.map->radiance(sample.direction) / sample.pdf};
  }
};

}  // namespace

std::optional<LightSample> sample_light(const Light& light, const Vec3& position, Rng& rng) {
  return std::visit(Sampler{position, rng}, light);
}

}  // namespace knotlight
