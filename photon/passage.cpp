#include "photon/passage.h"

#include <cmath>

#include "core/fresnel.h"
#include "core/microfacet.h"
#include "core/sampling.h"
#include "trace/surroundings.h"

namespace knotlight {
namespace {

bool contains(const Bounds& b, const Vec3& p, double slack) {
  return (p.array() >= b.lo.array() - slack).all() && (p.array() <= b.hi.array() + slack).all();
}

bool overlap(const Bounds& a, const Bounds& b, double slack) {
  return (a.lo.array() <= b.hi.array() + slack).all() &&
         (b.lo.array() <= a.hi.array() + slack).all();
}

}  // namespace

Passage::Passage(const Scene& scene, const RayCaster& caster, int channel)
    : scene_(scene), caster_(caster), channel_(channel), touch_(caster.touching_distance()) {
  std::vector<const Shape*> targets;
  for (const Object& object : scene.objects) {
    Item item{false, 0.0, 0.0, 0.0, 1.0, 0.0, bounds(object.shape), {}, {}};
    if (const TranslucentMaterial* material = object.translucent()) {
      const Medium medium = material->medium(channel);
      item.translucent = true;
      item.sigma_t = medium.sigma_t();
      item.albedo = medium.albedo();
      item.g = medium.g;
      item.ior = medium.ior;
      item.alpha = material->alpha();
      targets.push_back(&object.shape);
    }
    scene_bounds_.extend(item.bounds.lo);
    scene_bounds_.extend(item.bounds.hi);
    items_.push_back(std::move(item));
  }
  if (!targets.empty()) target_ = sphere_around(targets);
  for (std::size_t i = 0; i < items_.size(); ++i) {
    for (std::uint32_t j = 0; j < items_.size(); ++j) {
      if (i == j || !overlap(items_[i].bounds, items_[j].bounds, touch_)) continue;
      items_[i].touching.push_back(j);
      if (!items_[j].translucent) items_[i].touching_opaque.push_back(j);
    }
  }
}

LightRay Passage::start(const Vec3& position, const Vec3& direction) const {
  LightRay light{position, direction};
  if (const auto around = object_around(position)) {
    light.inside = true;
    light.object = *around;
  }
  return light;
}

// The translucent object that p lies in.
std::optional<std::uint32_t> Passage::object_around(const Vec3& p) const {
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (items_[i].translucent && contains(items_[i].bounds, p, 0.0) && caster_.inside(p, i))
      return i;
  return std::nullopt;
}

// Where the ray through p along d meets `object` within the touching distance of p, on either side:
// what a ray that starts at p would skip.
std::optional<Hit> Passage::contact(const Vec3& p, const Vec3& d, std::uint32_t object) const {
  return caster_.nearest({p - touch_ * d, d, 2.0 * touch_}, object);
}

// Light that leaves A where B touches it meets B's surface there;
// an opaque surface that touches a translucent one shields it from outside. One opaque surface on
// another does not: light that leaves the one leaves both.
std::optional<Hit> Passage::next_outside(const LightRay& light) const {
  if (light.on_surface) {
    if (items_[light.object].translucent)
      for (const std::uint32_t other : items_[light.object].touching_opaque)
        if (auto hit = contact(light.position, light.direction, other)) return hit;
    for (const std::uint32_t other : items_[light.object].touching) {
      if (!items_[other].translucent) continue;
      auto hit = contact(light.position, light.direction, other);
      if (hit && light.direction.dot(hit->normal) < 0.0) return hit;
    }
  }
  auto hit = caster_.nearest(light.ray());
  if (hit)
    for (const std::uint32_t other : items_[hit->object].touching_opaque)
      if (auto shield = contact(hit->position, light.direction, other)) return shield;
  return hit;
}

std::optional<Hit> Passage::next_inside(const LightRay& light, double distance) const {
  Ray ray = light.ray(distance);
  if (!light.on_surface) {
    // From the interior the search starts behind the photon, or it would skip a surface just ahead.
    ray.origin -= touch_ * light.direction;
    ray.t_max += touch_;
  }
  auto hit = caster_.nearest(ray);
  if (hit && !light.on_surface && hit->t <= touch_) {  // that surface lies behind the photon
    ray = light.ray(distance);
    hit = caster_.nearest(ray);
  }
  if (!hit || hit->object == light.object) return hit;

  Ray to_own = ray;
  to_own.t_max += touch_;
  const auto own = caster_.nearest(to_own, light.object);
  const bool before_own = !own || hit->t < own->t - touch_;
  if (!items_[hit->object].translucent && before_own) return hit;
  return own && own->t < ray.t_max ? own : std::nullopt;
}

double Passage::reflectance(const Hit& hit) const {
  return reflectance_at(scene_.objects[hit.object], hit)[channel_];
}

bool Passage::within_bounds(const Vec3& p, std::uint32_t object) const {
  return contains(items_[object].bounds, p, touch_);
}

Crossing cross_surface(const Vec3& direction, const Vec3& normal, double eta, double alpha,
                       Rng& rng) {
  if (alpha > 0.0) {
    const SurfaceEvent event = cross_rough_surface(direction, normal, eta, alpha, rng);
    return {event.direction, event.transmitted};
  }
  const auto refracted = refract(direction, normal, eta);
  const double u = rng.uniform();
  if (!refracted || u < fresnel_reflectance(std::abs(direction.dot(normal)), eta))
    return {reflect(direction, normal), false};
  return {*refracted, true};
}

LightRay reflected_diffusely(const LightRay& arriving, const Hit& hit, double u, double v) {
  const bool on_front = arriving.direction.dot(hit.normal) < 0.0;
  LightRay leaving = arriving;
  leaving.position = hit.position;
  leaving.direction =
      Frame(on_front ? hit.normal : Vec3(-hit.normal)).to_world(sample_cosine_hemisphere(u, v));
  leaving.on_surface = true;
  if (!arriving.inside) leaving.object = hit.object;
  return leaving;
}

}  // namespace knotlight
