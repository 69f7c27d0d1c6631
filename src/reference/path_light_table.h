// The lights of a scene as a path from the eye looks for them: by next-event estimation from its
// vertices, or by chance along its flights. Where both can find a light, the balance heuristic
// [VG95] weighs the two.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "reference/path_optics.h"
#include "scene/scene.h"

namespace knotlight {

template <int C>
struct LightTable {
  struct Point {
    Vec3 position;
    Channels<C> intensity;                // W/sr
    std::optional<std::uint32_t> medium;  // the object that it lies in; told by the caller
  };
  struct Directional {
    Vec3 towards;            // the light, unit
    Channels<C> irradiance;  // W per area normal to it
  };
  struct Area {
    const AreaLight* light;
    Channels<C> radiance;
    Vec3 normal;
    double area;

    // The distance at which the ray from `origin` along w meets it, on either side.
    std::optional<double> met(const Vec3& origin, const Vec3& w) const;
    bool shines_against(const Vec3& w) const { return normal.dot(w) < 0.0; }
    // Density per solid angle, seen from a point at that distance along w, of points that are
    // uniform on its area: r^2 / (|cos| area).
    double pdf(const Vec3& w, double distance) const {
      return distance * distance / (-normal.dot(w) * area);
    }
  };
  struct Sky {
    const EnvironmentMap* map;  // null: the same from everywhere, found by chance alone
    Channels<C> radiance;       // multiplies the map

    Channels<C> seen(const Vec3& w) const {
      return map != nullptr ? Channels<C>(radiance * channels<C>(map->radiance(w))) : radiance;
    }
  };

  explicit LightTable(const Scene& scene);

  // The nearest area light that a ray meets before t_max, as the eye sees it: black from behind.
  struct Body {
    double distance;
    Channels<C> radiance;
  };
  std::optional<Body> nearest_body(const Vec3& origin, const Vec3& w, double t_max) const;

  std::vector<Point> points;
  std::vector<Directional> directionals;
  std::vector<Area> areas;
  std::vector<Sky> skies;
  // Whether anything is found in both ways, so that densities of directions have to be kept.
  bool found_twice = false;
};

template <int C>
LightTable<C>::LightTable(const Scene& scene) {
  for (const Light& light : scene.lights) {
    if (const auto* point = std::get_if<PointLight>(&light)) {
      points.push_back({point->position, channels<C>(point->intensity), std::nullopt});
    } else if (const auto* beam = std::get_if<DirectionalLight>(&light)) {
      directionals.push_back({-beam->direction, channels<C>(beam->irradiance)});
    } else if (const auto* area = std::get_if<AreaLight>(&light)) {
      areas.push_back({area, channels<C>(area->radiance), area->normal(), area->area()});
      found_twice = true;
    } else {
      const auto& sky = std::get<EnvironmentLight>(light);
      skies.push_back({sky.map.get(), channels<C>(sky.radiance)});
      found_twice = found_twice || sky.map != nullptr;
    }
  }
}

template <int C>
std::optional<double> LightTable<C>::Area::met(const Vec3& origin, const Vec3& w) const {
  const double facing = normal.dot(w);
  if (facing == 0.0) return std::nullopt;
  const double t = normal.dot(light->center - origin) / facing;
  if (t <= 0.0) return std::nullopt;
  // Coordinates in the basis (u, v); |u x v| = area / 4.
  const Vec3 offset = origin + t * w - light->center;
  const double along_u = offset.cross(light->v).dot(normal) / (0.25 * area);
  const double along_v = light->u.cross(offset).dot(normal) / (0.25 * area);
  if (std::abs(along_u) > 1.0 || std::abs(along_v) > 1.0) return std::nullopt;
  return t;
}

template <int C>
auto LightTable<C>::nearest_body(const Vec3& origin, const Vec3& w, double t_max) const
    -> std::optional<Body> {
  std::optional<Body> nearest;
  for (const Area& light : areas) {
    const auto t = light.met(origin, w);
    if (!t || *t >= (nearest ? nearest->distance : t_max)) continue;
    nearest = Body{*t, light.shines_against(w) ? light.radiance : Channels<C>(Channels<C>::Zero())};
  }
  return nearest;
}

}  // namespace knotlight
