#include "photon/emission.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "core/sampling.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Rays start this much outside the scene's sphere, so that none starts behind what it should meet.
constexpr double scene_sphere_slack = 1.001;

// Points per side of the fixed grids behind the estimates for the choice among lights; these
// estimates move noise between lights, never the mean.
constexpr int area_estimate_grid = 4;
constexpr int map_estimate_grid = 32;

// Like sample_cone, from 1 - cos of the half angle: a cone as narrow as that of a distant light
// keeps its digits.
Vec3 sample_narrow_cone(double u, double v, double cosine_max_deficit) {
  const double deficit = u * cosine_max_deficit;
  const double sin_theta = std::sqrt(std::max(0.0, deficit * (2.0 - deficit)));
  const double phi = 2.0 * pi * v;
  return {sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1.0 - deficit};
}

}  // namespace

double Emitter::Cone::solid_angle() const {
  return 2.0 * pi * cosine_max_deficit;
}

Emitter::Emitter(const std::vector<Light>& lights, int channel, const Sphere& target,
                 const Bounds& scene_bounds)
    : channel_(channel),
      center_(target.center),
      radius_(target.radius),
      scene_center_(scene_bounds.center()),
      scene_radius_(scene_sphere_slack * scene_bounds.radius()) {
  for (const Light& light : lights) {
    const double power = std::visit([this](const auto& l) { return power_estimate(l); }, light);
    if (power > 0.0) sources_.push_back({&light, power});
    total_ += power;
  }
}

EmittedPhoton Emitter::sample(Rng& rng) const {
  double x = rng.uniform() * total_;
  std::size_t light = 0;
  while (light + 1 < sources_.size() && x >= sources_[light].power) x -= sources_[light++].power;
  std::array<double, 4> u{};
  for (int i = 0; i < dimensions(light); ++i) u[static_cast<std::size_t>(i)] = rng.uniform();
  EmittedPhoton photon = ray(light, u);
  photon.power *= total_ / sources_[light].power;
  return photon;
}

int Emitter::dimensions(std::size_t light) const {
  const Light& l = *sources_[light].light;
  return std::holds_alternative<PointLight>(l) || std::holds_alternative<DirectionalLight>(l) ? 2
                                                                                              : 4;
}

EmittedPhoton Emitter::ray(std::size_t light, const std::array<double, 4>& u) const {
  return std::visit([&](const auto& l) { return ray_of(l, u); }, *sources_[light].light);
}

Emitter::Cone Emitter::cone_from(const Vec3& p) const {
  const Vec3 to_center = center_ - p;
  const double distance = to_center.norm();
  if (distance <= radius_) return {Vec3::UnitZ(), 2.0};
  const double sin2 = (radius_ / distance) * (radius_ / distance);
  return {to_center / distance, sin2 / (1.0 + std::sqrt(1.0 - sin2))};
}

// Moves the start of a ray from outside the scene up to the scene's sphere: nothing is in between,
// and a ray cast from far away would lose digits.
Vec3 Emitter::start(const Vec3& origin, const Vec3& direction) const {
  const Vec3 to_center = scene_center_ - origin;
  if (to_center.norm() <= scene_radius_) return origin;
  const double along = to_center.dot(direction);
  const double miss2 = (to_center - along * direction).squaredNorm();
  const double half_chord = std::sqrt(std::max(0.0, scene_radius_ * scene_radius_ - miss2));
  return origin + std::max(0.0, along - half_chord) * direction;
}

// A point of the disc that faces `direction` and covers the target, moved back out of the scene.
// Density 1/(pi radius^2) per area normal to the direction.
Vec3 Emitter::start_of_parallel_ray(const Vec3& direction, double u, double v) const {
  const Eigen::Vector2d p = radius_ * sample_disc(u, v);
  const double back = (center_ - scene_center_).norm() + scene_radius_;
  return center_ + Frame(direction).to_world({p.x(), p.y(), -back});
}

double Emitter::power_estimate(const PointLight& light) const {
  return light.intensity[channel_] * cone_from(light.position).solid_angle();
}

EmittedPhoton Emitter::ray_of(const PointLight& light, const std::array<double, 4>& u) const {
  const Cone cone = cone_from(light.position);
  const Vec3 d = Frame(cone.axis).to_world(sample_narrow_cone(u[0], u[1], cone.cosine_max_deficit));
  return {start(light.position, d), d, light.intensity[channel_] * cone.solid_angle()};
}

double Emitter::power_estimate(const DirectionalLight& light) const {
  return light.irradiance[channel_] * pi * radius_ * radius_;
}

EmittedPhoton Emitter::ray_of(const DirectionalLight& light, const std::array<double, 4>& u) const {
  const Vec3 origin = start_of_parallel_ray(light.direction, u[0], u[1]);
  return {origin, light.direction, light.irradiance[channel_] * pi * radius_ * radius_};
}

// Mean over the light of the smaller of the whole hemisphere's power and a bound on what goes into
// the cone. Zero only if the target lies wholly behind the light's plane, where nothing shines.
double Emitter::power_estimate(const AreaLight& light) const {
  if (light.normal().dot(center_ - light.center) <= -radius_) return 0.0;
  double sum = 0.0;
  for (int i = 0; i < area_estimate_grid; ++i) {
    for (int j = 0; j < area_estimate_grid; ++j) {
      const double a = 2.0 * (i + 0.5) / area_estimate_grid - 1.0;
      const double b = 2.0 * (j + 0.5) / area_estimate_grid - 1.0;
      const Cone cone = cone_from(light.center + a * light.u + b * light.v);
      const double axis_angle = std::acos(std::clamp(light.normal().dot(cone.axis), -1.0, 1.0));
      const double half_angle = std::acos(1.0 - cone.cosine_max_deficit);
      const double largest_cosine = std::cos(std::max(0.0, axis_angle - half_angle));
      sum += std::min(pi, cone.solid_angle() * std::max(0.0, largest_cosine));
    }
  }
  return light.radiance[channel_] * light.area() * sum / (area_estimate_grid * area_estimate_grid);
}

EmittedPhoton Emitter::ray_of(const AreaLight& light, const std::array<double, 4>& u) const {
  const double a = 2.0 * u[2] - 1.0;
  const double b = 2.0 * u[3] - 1.0;
  const Vec3 p = light.center + a * light.u + b * light.v;
  const Vec3 n = light.normal();
  const double radiosity = light.radiance[channel_] * light.area();  // W/sr at the normal
  // The narrower of the two densities wastes fewer rays; which one depends on p alone, so either
  // way the mean is right.
  const Cone cone = cone_from(p);
  if (cone.solid_angle() >= pi) {
    const Vec3 d = Frame(n).to_world(sample_cosine_hemisphere(u[0], u[1]));
    return {start(p, d), d, radiosity * pi};
  }
  const Vec3 d = Frame(cone.axis).to_world(sample_narrow_cone(u[0], u[1], cone.cosine_max_deficit));
  return {start(p, d), d, radiosity * std::max(0.0, n.dot(d)) * cone.solid_angle()};
}

double Emitter::power_estimate(const EnvironmentLight& light) const {
  const double disc = pi * radius_ * radius_;
  const double tint = light.radiance[channel_];
  if (!light.map) return tint * 4.0 * pi * disc;
  // The mean of the channels, because that is what the map's density follows: a colour that the
  // grid misses still keeps its share.
  double sum = 0.0;
  for (int i = 0; i < map_estimate_grid; ++i) {
    for (int j = 0; j < map_estimate_grid; ++j) {
      const auto s =
          light.map->sample((i + 0.5) / map_estimate_grid, (j + 0.5) / map_estimate_grid);
      if (s.pdf > 0.0) sum += light.map->radiance(s.direction).mean() / s.pdf;
    }
  }
  return tint * disc * sum / (map_estimate_grid * map_estimate_grid);
}

EmittedPhoton Emitter::ray_of(const EnvironmentLight& light, const std::array<double, 4>& u) const {
  const double disc = pi * radius_ * radius_;
  const double tint = light.radiance[channel_];
  if (!light.map) {
    const Vec3 d = sample_sphere(u[2], u[3]);
    return {start_of_parallel_ray(d, u[0], u[1]), d, tint * 4.0 * pi * disc};
  }
  const EnvironmentMap::Sample s = light.map->sample(u[2], u[3]);
  const double radiance = tint * light.map->radiance(s.direction)[channel_];
  const Vec3 d = -s.direction;
  return {start_of_parallel_ray(d, u[0], u[1]), d, radiance / s.pdf * disc};
}

}  // namespace knotlight
