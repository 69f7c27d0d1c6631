#include "photon/first_light_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/fresnel.h"
#include "photon/depth_rule.h"
#include "photon/emission.h"
#include "photon/low_discrepancy.h"
#include "photon/passage.h"

namespace knotlight {
namespace {

constexpr std::size_t rays_per_chunk = 4096;  // milliseconds of work

// A branch with less than this share of its ray's power is played for: the sum of what is dropped
// and raised is zero in the mean, and its share of the variance is the square of this.
constexpr double least_share = 1e-3;

// Branches in a slab between mirrors decay by the Fresnel reflectance or the roulette; so many
// means that rounding has caught the light in an edge.
constexpr int most_events = 10'000;

// Ends of flights that carry less than this share of the light at their start are left out.
constexpr double nothing_left = 1e-12;

struct Branch : LightRay {
  double power = 0.0;
  Vec3 normal = Vec3::Zero();  // outward, of the surface that it starts on; zero: on none
};

// What is left behind, per scene object.
struct Deposit {
  std::vector<std::vector<VolumePhoton>> photons;
  std::vector<std::vector<FlightEnd>> ends;
};

// Follows one ray with all its branches.
class RayFollower {
 public:
  RayFollower(const Passage& passage, const FirstLightOptions& options)
      : passage_(passage), options_(options) {}

  // offset: of the stratified depths, in [0, 1). Adds to the deposit.
  void follow(const EmittedPhoton& start, double offset, Rng& rng, Deposit& deposit) {
    least_power_ = least_share * start.power;
    offset_ = offset;
    branches_.assign(1, {passage_.start(start.origin, start.direction), start.power});
    for (int events = 0; !branches_.empty() && events < most_events; ++events) {
      Branch branch = branches_.back();
      branches_.pop_back();
      if (branch.power < least_power_) {
        if (rng.uniform() * least_power_ >= branch.power) continue;
        branch.power = least_power_;
      }
      if (branch.inside)
        cross(branch, deposit);
      else
        arrive(branch);
    }
  }

 private:
  // Free space up to the next surface, and what it makes of the light.
  void arrive(const Branch& branch) {
    const auto hit = passage_.next_outside(branch);
    if (!hit || !passage_.item(hit->object).translucent) return;
    if (branch.direction.dot(hit->normal) >= 0.0) return;  // its front was missed: rounding
    split(branch, *hit, passage_.item(hit->object).ior, true);
  }

  // A medium from where the light is to where it leaves.
  void cross(const Branch& branch, Deposit& deposit) {
    const Passage::Item& item = passage_.item(branch.object);
    const auto hit = passage_.next_inside(branch, std::numeric_limits<double>::infinity());
    if (!hit) return;  // the way out was missed: rounding
    const double length = std::max(0.0, (hit->position - branch.position).dot(branch.direction));
    const double tau = item.sigma_t * length;
    if (options_.depths == FirstLightOptions::Depths::stratified)
      stratified_depths(tau, options_.points_per_ray, offset_, depths_);
    else
      gauss_depths(tau, options_.points_per_ray, depths_);
    for (const DepthPoint& point : depths_)
      deposit.photons[branch.object].push_back(
          {branch.position + point.optical_depth / item.sigma_t * branch.direction,
           branch.direction, branch.power * point.weight, 1});
    Branch rest = branch;
    rest.power *= std::exp(-tau);
    if (item.g != 0.0) {
      std::vector<FlightEnd>& ends = deposit.ends[branch.object];
      ends.push_back({branch.position, branch.normal, -branch.power});
      if (rest.power > nothing_left * branch.power)
        ends.push_back(
            {hit->position, hit->object == branch.object ? hit->normal : Vec3::Zero(), rest.power});
    }
    if (hit->object != branch.object) return;  // an opaque object inside the medium
    if (branch.direction.dot(hit->normal) > 0.0) split(rest, *hit, 1.0 / item.ior, false);
  }

  // Refraction and reflection at a surface; eta = index beyond over index before it.
  void split(const Branch& branch, const Hit& hit, double eta, bool entering) {
    const double cosine = std::abs(branch.direction.dot(hit.normal));
    const auto refracted = refract(branch.direction, hit.normal, eta);
    const double reflectance = refracted ? fresnel_reflectance(cosine, eta) : 1.0;
    Branch next = branch;
    next.position = hit.position;
    next.object = hit.object;
    next.on_surface = true;
    next.normal = hit.normal;
    if (reflectance > 0.0) {
      next.direction = reflect(branch.direction, hit.normal);
      next.power = branch.power * reflectance;
      next.inside = !entering;
      branches_.push_back(next);
    }
    if (reflectance < 1.0) {
      next.direction = *refracted;
      next.power = branch.power * (1.0 - reflectance);
      next.inside = entering;
      branches_.push_back(next);
    }
  }

  const Passage& passage_;
  const FirstLightOptions& options_;
  double least_power_ = 0.0;
  double offset_ = 0.0;
  std::vector<Branch> branches_;
  std::vector<DepthPoint> depths_;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// How many rays each light gets: by its share of the power, at least one each.
std::vector<std::size_t> allot(const Emitter& emitter, std::size_t rays) {
  std::vector<std::size_t> counts;
  for (std::size_t light = 0; light < emitter.lights(); ++light)
    counts.push_back(
        std::max<std::size_t>(1, std::llround(emitter.share(light) * static_cast<double>(rays))));
  return counts;
}

}  // namespace

FirstLight trace_first_light(const Scene& scene, const RayCaster& caster, int channel,
                             const FirstLightOptions& options, const Workers& workers,
                             Stage& stage) {
  const std::size_t objects = scene.objects.size();
  FirstLight result;
  result.photons.resize(objects);
  result.ends.resize(objects);
  const Passage passage(scene, caster, channel);
  if (!passage.target() || options.rays == 0) return result;
  const Emitter emitter(scene.lights, channel, *passage.target(), passage.scene_bounds());
  if (!emitter.any()) return result;

  const std::vector<std::size_t> counts = allot(emitter, options.rays);
  for (std::size_t light = 0; light < counts.size(); ++light) {
    const int dimensions = emitter.dimensions(light);
    // One sequence per light. Place on the target and depth in the medium are its first three
    // coordinates, since they say where the photon ends up; the place on the light follows.
    const LowDiscrepancy points(dimensions + 1, options.seed,
                                options.replicate * emitter.lights() + light);
    const std::size_t chunks = (counts[light] + rays_per_chunk - 1) / rays_per_chunk;
    std::vector<Deposit> parts(chunks);
    std::vector<double> emitted(chunks, 0.0);
    workers.for_chunks(counts[light], rays_per_chunk,
                       [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                         Deposit deposit{std::vector<std::vector<VolumePhoton>>(objects),
                                         std::vector<std::vector<FlightEnd>>(objects)};
                         RayFollower follower(passage, options);
                         for (std::size_t i = begin; i < end; ++i) {
                           std::array<double, 4> u{};
                           for (int d = 0; d < dimensions; ++d)
                             u[static_cast<std::size_t>(d)] = points(i, d < 2 ? d : d + 1);
                           EmittedPhoton start = emitter.ray(light, u);
                           start.power /= static_cast<double>(counts[light]);
                           if (start.power == 0.0) continue;
                           emitted[chunk] += start.power;
                           Rng rng(options.seed, Stream::surface_events,
                                   (options.replicate * counts.size() + light) << 32 | i);
                           follower.follow(start, points(i, 2), rng, deposit);
                         }
                         parts[chunk] = std::move(deposit);
                         stage.advance(end - begin);
                       });
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      result.emitted += emitted[chunk];
      for (std::size_t object = 0; object < objects; ++object) {
        append(result.photons[object], parts[chunk].photons[object]);
        append(result.ends[object], parts[chunk].ends[object]);
      }
    }
  }
  return result;
}

}  // namespace knotlight
