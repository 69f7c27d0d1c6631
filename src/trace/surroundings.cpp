#include "trace/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "trace/direct_light.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// A path goes on with at most this probability, its light raised accordingly: between surfaces that
// reflect everything no path is endless.
constexpr double surest_continuation = 0.95;

// A diffuse surface in sight, and what index-matched objects let through on the way to it.
struct Seen {
  Hit hit;
  Spectrum transmittance;
};

// Nothing if the ray leaves the scene, meets a refracting object, or a diffuse one inside another.
std::optional<Seen> next_diffuse(const Scene& scene, const RayCaster& caster, const Ray& ray) {
  Ray rest = ray;
  std::vector<std::uint32_t> crossed;  // index-matched objects, once each
  std::vector<std::uint32_t> around;   // those the ray is inside of
  std::optional<Hit> hit;
  while ((hit = caster.nearest(rest))) {
    const TranslucentMaterial* material = scene.objects[hit->object].translucent();
    if (material == nullptr) break;
    if (material->ior != 1.0) return std::nullopt;
    if (std::find(crossed.begin(), crossed.end(), hit->object) == crossed.end())
      crossed.push_back(hit->object);
    std::erase(around, hit->object);
    if (ray.direction.dot(hit->normal) < 0.0) {
      around.push_back(hit->object);
    } else if (const auto contact = opaque_contact(scene, caster, hit->position, ray.direction)) {
      hit = contact;
      break;
    }
    rest.origin = hit->position;
  }
  if (!hit || !around.empty()) return std::nullopt;
  Spectrum optical_depth = Spectrum::Zero();
  const Ray whole{ray.origin, ray.direction, (hit->position - ray.origin).dot(ray.direction)};
  for (const std::uint32_t object : crossed) {
    const TranslucentMaterial& material = *scene.objects[object].translucent();
    optical_depth +=
        (material.sigma_a + material.sigma_s) * caster.path_length_inside(whole, object);
  }
  return Seen{*hit, (-optical_depth).exp()};
}

}  // namespace

Spectrum reflectance_at(const Object& object, const Hit& hit) {
  const auto* diffuse = std::get_if<DiffuseMaterial>(&object.material);
  if (diffuse == nullptr) return Spectrum::Zero();
  const auto* mesh = std::get_if<TriangleMesh>(&object.shape);
  if (mesh == nullptr || mesh->colours.empty()) return diffuse->reflectance;
  const Triangle& corners = mesh->triangles[hit.primitive];
  return diffuse->reflectance *
         ((1.0 - hit.b1 - hit.b2) * mesh->colours[corners[0]] + hit.b1 * mesh->colours[corners[1]] +
          hit.b2 * mesh->colours[corners[2]]);
}

bool surroundings_reflect(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [](const Object& object) {
    const auto* diffuse = std::get_if<DiffuseMaterial>(&object.material);
    return diffuse != nullptr && (diffuse->reflectance > 0.0).any();
  });
}

Spectrum reflected_radiance(const Scene& scene, const RayCaster& caster, const Hit& hit,
                            const Vec3& direction, Rng& rng) {
  Spectrum sum = Spectrum::Zero();
  Seen at{hit, Spectrum::Ones()};
  Vec3 arriving = direction;
  Spectrum throughput = Spectrum::Ones();
  while (true) {
    const Vec3 n = arriving.dot(at.hit.normal) < 0.0 ? at.hit.normal : Vec3(-at.hit.normal);
    throughput *= at.transmittance * reflectance_at(scene.objects[at.hit.object], at.hit);
    sum += throughput / pi * sample_irradiance(scene, caster, at.hit.position, n, rng);
    // The cosine of the reflected light cancels against the density of the next direction.
    const double going_on = std::min(surest_continuation, throughput.maxCoeff());
    if (!(rng.uniform() < going_on)) return sum;
    throughput /= going_on;
    const double u = rng.uniform();
    const double v = rng.uniform();
    arriving = Frame(n).to_world(sample_cosine_hemisphere(u, v));
    const auto next = next_diffuse(scene, caster, {at.hit.position, arriving});
    if (!next) return sum;
    at = *next;
  }
}

Spectrum sample_surroundings_irradiance(const Scene& scene, const RayCaster& caster,
                                        const Vec3& position, const Vec3& normal, Rng& rng,
                                        double ior) {
  const double u = rng.uniform();
  const double v = rng.uniform();
  const Vec3 w = Frame(normal).to_world(sample_cosine_hemisphere(u, v));
  const auto seen = next_diffuse(scene, caster, {position, w});
  if (!seen) return Spectrum::Zero();
  return pi * (1.0 - fresnel_reflectance(w.dot(normal), ior)) * seen->transmittance *
         reflected_radiance(scene, caster, seen->hit, w, rng);
}

}  // namespace knotlight
