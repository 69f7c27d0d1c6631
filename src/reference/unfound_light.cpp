#include "reference/unfound_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.h"
#include "core/fresnel.h"
#include "core/sampling.h"
#include "reference/path_surfaces.h"
#include "reference/refracted_ways.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

constexpr std::uint64_t rays = 20'000;  // per light: the share to 1 % of itself or 1e-4 of all
// Mirrored again and again without being scattered: what is left then is small or never leaves.
constexpr int most_surfaces = 64;

struct LampRay {
  PathRay ray;
  double power;  // mean over the channels, of each ray
};

LampRay leave(const PointLight& light, const Sphere& target, Rng& rng) {
  const Vec3 to_center = target.center - light.position;
  const double distance = to_center.norm();
  const bool beside = distance > target.radius;
  const double sine = beside ? target.radius / distance : 0.0;
  const double cosine = beside ? std::sqrt(1.0 - sine * sine) : -1.0;
  const double u = rng.uniform();
  const Vec3 local = sample_cone(u, rng.uniform(), cosine);
  LampRay lamp;
  lamp.ray.position = light.position;
  lamp.ray.direction = beside ? Frame(to_center / distance).to_world(local).normalized() : local;
  lamp.power = light.intensity.mean() * (1.0 - cosine);
  return lamp;
}

LampRay leave(const DirectionalLight& light, const Sphere& target, Rng& rng) {
  const double u = rng.uniform();
  const Eigen::Vector2d p = target.radius * sample_disc(u, rng.uniform());
  const Frame frame(light.direction);
  LampRay lamp;
  lamp.ray.position =
      target.center + p.x() * frame.t + p.y() * frame.b - 2.0 * target.radius * light.direction;
  lamp.ray.direction = light.direction;
  lamp.power = light.irradiance.mean() * 0.5 * target.radius * target.radius;
  return lamp;
}

struct Shares {
  double found = 0.0, unfound = 0.0;
};

// Per object, whether light that has been refracted into it is found when mirrored inside.
std::vector<bool> objects_with_mirrors(const Scene& scene) {
  std::vector<bool> mirrors;
  for (const Object& object : scene.objects) {
    const TranslucentMaterial* material = object.translucent();
    mirrors.push_back(material != nullptr && material->ior != 1.0 &&
                      RefractingSurface(object.shape, material->ior).finds_mirrored());
  }
  return mirrors;
}

// Follows light to where it is first scattered. Ways that can be found: straight, and one
// refraction into the object where it is scattered, with a few mirrors in some.
void follow(LampRay lamp, const Scene& scene, const PathSurfaces& surfaces,
            const std::vector<bool>& has_mirrors, int channel, Rng& rng, Shares& shares) {
  int mirrors = 0;
  enum class Past { straight, refracted_in, else_where } past = Past::straight;
  PathRay& ray = lamp.ray;
  if (const auto around = surfaces.medium_around(ray.position)) {
    ray.inside = true;
    ray.medium = *around;
  }
  for (int i = 0; i < most_surfaces; ++i) {
    double flight = std::numeric_limits<double>::infinity();
    std::optional<Medium> medium;
    if (ray.inside) medium = scene.objects[ray.medium].translucent()->medium(channel);
    if (medium && medium->sigma_t() > 0.0)
      flight = sample_free_flight(rng.uniform(), medium->sigma_t());
    const auto hit = surfaces.next(ray, flight);
    const auto scattered = [&](double share) {
      (past == Past::else_where ? shares.unfound : shares.found) += lamp.power * share;
    };
    if (!hit) {
      if (medium) scattered(medium->albedo());
      return;
    }
    const Object& object = scene.objects[hit->object];
    if (object.translucent() == nullptr) return scattered(reflectance_at(object, *hit)[channel]);
    const double ior = object.translucent()->ior;
    const bool leaving = ray.inside;
    const double facing = hit->normal.dot(ray.direction);
    if (leaving ? facing <= 0.0 : facing >= 0.0) return;
    ray.position = hit->position;
    ray.surface = hit->object;
    ray.medium = hit->object;
    const double ahead = leaving ? 1.0 / ior : ior;
    const auto refracted = refract(ray.direction, hit->normal, ahead);
    const bool mirrored =
        !refracted || rng.uniform() < fresnel_reflectance(std::abs(facing), ahead);
    if (mirrored) {
      const bool known = leaving && past == Past::refracted_in && has_mirrors[hit->object];
      if (!known || ++mirrors > most_mirrors) past = Past::else_where;
    } else if (ior != 1.0) {
      past = leaving || past != Past::straight ? Past::else_where : Past::refracted_in;
    }
    ray.direction = mirrored ? reflect(ray.direction, hit->normal) : *refracted;
    if (!mirrored) ray.inside = !leaving;
  }
}

bool has_no_size(const Light& light) {
  return std::holds_alternative<PointLight>(light) ||
         std::holds_alternative<DirectionalLight>(light);
}

}  // namespace

double unfound_share(const Scene& scene, const RayCaster& caster, std::uint64_t seed) {
  const PathSurfaces surfaces(scene, caster);
  const std::vector<bool> has_mirrors = objects_with_mirrors(scene);
  std::vector<const Shape*> shapes;
  for (const Object& object : scene.objects) shapes.push_back(&object.shape);
  const Sphere target = sphere_around(shapes);
  Shares shares;
  for (std::size_t light = 0; light < scene.lights.size(); ++light) {
    if (!has_no_size(scene.lights[light])) continue;
    for (std::uint64_t i = 0; i < rays; ++i) {
      Rng rng(seed, Stream::reference_lamps, light * rays + i);
      const auto* point = std::get_if<PointLight>(&scene.lights[light]);
      const LampRay lamp =
          point != nullptr ? leave(*point, target, rng)
                           : leave(std::get<DirectionalLight>(scene.lights[light]), target, rng);
      follow(lamp, scene, surfaces, has_mirrors, static_cast<int>(i) % scene.channels, rng, shares);
    }
  }
  const double all = shares.found + shares.unfound;
  return all > 0.0 ? shares.unfound / all : 0.0;
}

void refuse_unfindable_lights(const Scene& scene) {
  if (std::none_of(scene.lights.begin(), scene.lights.end(), has_no_size)) return;
  for (const Object& object : scene.objects)
    if (object.translucent() != nullptr && object.translucent()->alpha() > 0.0)
      throw InputError(fmt::format(
          "objects.{}: is rough, and a point light or beam cannot be found through it, expected "
          "roughness 0 or small area lights",
          object.name));
}

}  // namespace knotlight
