#include "photon/first_light_tracer.h"

#include <algorithm>
#include <cmath>

#include "core/fresnel.h"
#include "core/not_finite.h"
#include "photon/depth_rule.h"
#include "photon/emission.h"
#include "photon/low_discrepancy.h"
#include "photon/passage.h"
#include "photon/surroundings_light.h"

namespace knotlight {
namespace {

constexpr std::size_t rays_per_chunk = 4096;  // milliseconds of work

// A branch with less than this share of its ray's power is played for: the sum of what is dropped
// and raised is zero in the mean, and its share of the variance is the square of this.
constexpr double least_branch_share = 1e-3;

// Branches in a slab between mirrors decay by the Fresnel reflectance or the roulette; so many
// means that rounding has caught the light in an edge.
constexpr int most_events = 10'000;

// Ends of flights that carry less than this share of the light at their start are left out.
constexpr double nothing_left = 1e-12;

// Above the keys of any number of replicates of the lights' sequences.
constexpr std::uint64_t surroundings_key = std::uint64_t{1} << 32U;

struct Branch : LightRay {
  double power = 0.0;
  Vec3 normal = Vec3::Zero();  // outward, of the object's surface that it starts on; zero: on none
  std::uint32_t surface = 0;   // the triangle
  bool straight = true;  // nothing but index-matched media since the light, or the surroundings
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
  void follow(const LightRay& start, double power, double offset, Rng& rng, Deposit& deposit) {
    least_power_ = least_branch_share * power;
    offset_ = offset;
    branches_.assign(1, {start, power});
    for (int events = 0; !branches_.empty() && events < most_events; ++events) {
      Branch branch = branches_.back();
      branches_.pop_back();
      if (branch.power < least_power_) {
        if (rng.uniform() * least_power_ >= branch.power) continue;
        branch.power = least_power_;
      }
      if (branch.inside)
        cross(branch, rng, deposit);
      else
        arrive(branch, rng);
    }
  }

 private:
  // Free space up to the next surface, and what it makes of the light.
  void arrive(const Branch& branch, Rng& rng) {
    const auto hit = passage_.next_outside(branch);
    if (!hit) return;
    if (!passage_.item(hit->object).translucent) {
      if (!branch.straight) reflect_diffusely(branch, *hit, rng);  // else it is SurroundingsLight's
      return;
    }
    if (branch.direction.dot(hit->normal) >= 0.0) return;  // its front was missed: rounding
    const Passage::Item& item = passage_.item(hit->object);
    split(branch, *hit, item.ior, item.alpha, true, rng);
  }

  // A medium from where the light is to where it leaves.
  void cross(const Branch& branch, Rng& rng, Deposit& deposit) {
    const Passage::Item& item = passage_.item(branch.object);
    const auto hit = passage_.next_inside(branch, infinity);
    if (!hit) return;  // the way out was missed: rounding
    const double length = std::max(0.0, (hit->position - branch.position).dot(branch.direction));
    const double tau = item.sigma_t * length;
    if (options_.depths == FirstLightOptions::Depths::stratified)
      stratified_depths(tau, options_.points_per_ray, offset_, depths_);
    else
      gauss_depths(tau, options_.points_per_ray, depths_);
    const double down = -branch.direction.dot(branch.normal);  // 0 if it starts on no surface
    const double up = hit->object == branch.object ? branch.direction.dot(hit->normal) : 0.0;
    for (const DepthPoint& point : depths_) {
      const double way = point.optical_depth / item.sigma_t;
      const double below_start = down > 0.0 ? way * down : infinity;
      const double below_end = up > 0.0 ? (length - way) * up : infinity;
      deposit.photons[branch.object].push_back(
          {branch.position + way * branch.direction, branch.direction, branch.power * point.weight,
           1, below_start <= below_end ? branch.surface : hit->primitive,
           std::min(below_start, below_end)});
    }
    Branch rest = branch;
    rest.power *= std::exp(-tau);
    if (item.g != 0.0) {
      std::vector<FlightEnd>& ends = deposit.ends[branch.object];
      ends.push_back({branch.position, branch.normal, -branch.power});
      if (rest.power > nothing_left * branch.power)
        ends.push_back(
            {hit->position, hit->object == branch.object ? hit->normal : Vec3::Zero(), rest.power});
    }
    if (hit->object != branch.object)  // an opaque object inside the medium
      reflect_diffusely(rest, *hit, rng);
    else if (branch.direction.dot(hit->normal) > 0.0)
      split(rest, *hit, 1.0 / item.ior, item.alpha, false, rng);
  }

  // One direction, drawn at random, for all that a diffuse surface reflects.
  void reflect_diffusely(const Branch& branch, const Hit& hit, Rng& rng) {
    const double reflectance = passage_.reflectance(hit);
    if (reflectance == 0.0) return;
    const double u = rng.uniform();
    const double v = rng.uniform();
    branches_.push_back({reflected_diffusely(branch, hit, u, v), branch.power * reflectance,
                         Vec3::Zero(), 0, false});
  }

  // Refraction and reflection at a surface; eta = index beyond over index before it. A rough one
  // has too many directions to split into: one is drawn at random.
  void split(const Branch& branch, const Hit& hit, double eta, double alpha, bool entering,
             Rng& rng) {
    Branch next = branch;
    next.position = hit.position;
    next.object = hit.object;
    next.on_surface = true;
    next.normal = hit.normal;
    next.surface = hit.primitive;
    next.straight = branch.straight && eta == 1.0;
    const auto go_on = [&](const Vec3& direction, bool through, double share) {
      next.direction = direction;
      next.inside = through == entering;
      next.power = branch.power * share;
      branches_.push_back(next);
    };
    if (alpha > 0.0) {
      const Crossing crossing = cross_surface(branch.direction, hit.normal, eta, alpha, rng);
      go_on(crossing.direction, crossing.through, 1.0);
      return;
    }
    const double cosine = std::abs(branch.direction.dot(hit.normal));
    const auto refracted = refract(branch.direction, hit.normal, eta);
    const double reflectance = refracted ? fresnel_reflectance(cosine, eta) : 1.0;
    if (reflectance > 0.0) go_on(reflect(branch.direction, hit.normal), false, reflectance);
    if (reflectance < 1.0) go_on(*refracted, true, 1.0 - reflectance);
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
  // Calls trace(i, follower, deposit), which returns what lights have sent, for i < count, and puts
  // together what is left behind in the order of i. `bar` may be null.
  const auto for_rays = [&](std::size_t count, Stage* bar, const auto& trace) {
    const std::size_t chunks = (count + rays_per_chunk - 1) / rays_per_chunk;
    std::vector<Deposit> parts(chunks);
    std::vector<double> sent(chunks, 0.0);
    workers.for_chunks(count, rays_per_chunk,
                       [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                         Deposit deposit{std::vector<std::vector<VolumePhoton>>(objects),
                                         std::vector<std::vector<FlightEnd>>(objects)};
                         RayFollower follower(passage, options);
                         for (std::size_t i = begin; i < end; ++i)
                           sent[chunk] += trace(i, follower, deposit);
                         parts[chunk] = std::move(deposit);
                         if (bar != nullptr) bar->advance(end - begin);
                       });
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      result.emitted += sent[chunk];
      for (std::size_t object = 0; object < objects; ++object) {
        append(result.photons[object], parts[chunk].photons[object]);
        append(result.ends[object], parts[chunk].ends[object]);
      }
    }
  };

  const Emitter emitter(scene.lights, channel, *passage.target(), passage.scene_bounds());
  const std::vector<std::size_t> counts = allot(emitter, options.rays);
  for (std::size_t light = 0; light < counts.size(); ++light) {
    const int dimensions = emitter.dimensions(light);
    // One sequence per light. Place on the target and depth in the medium are its first three
    // coordinates, since they say where the photon ends up; the place on the light follows.
    const LowDiscrepancy points(dimensions + 1, options.seed,
                                options.replicate * emitter.lights() + light);
    for_rays(counts[light], &stage, [&](std::size_t i, RayFollower& follower, Deposit& deposit) {
      std::array<double, 4> u{};
      for (int d = 0; d < dimensions; ++d)
        u[static_cast<std::size_t>(d)] = points(i, d < 2 ? d : d + 1);
      const EmittedPhoton start = emitter.ray(light, u);
      const double power = start.power / static_cast<double>(counts[light]);
      if (power == 0.0) return 0.0;
      Rng rng(options.seed, Stream::surface_events,
              (options.replicate * counts.size() + light) << 32 | i);
      follower.follow(passage.start(start.origin, start.direction), power, points(i, 2), rng,
                      deposit);
      return power;
    });
  }

  const SurroundingsLight surroundings(scene, caster, passage);
  const std::size_t reflected = surroundings.photons_beside(emitter, channel, options.rays);
  const LowDiscrepancy points(5, options.seed, surroundings_key + options.replicate);
  for_rays(reflected, nullptr, [&](std::size_t i, RayFollower& follower, Deposit& deposit) {
    Rng rng(options.seed, Stream::surroundings, options.replicate << 32 | i);
    const SurroundingsLight::Photon photon =
        surroundings.sample({points(i, 0), points(i, 1), points(i, 3), points(i, 4)}, rng);
    const double power = photon.power[channel] / static_cast<double>(reflected);
    if (power > 0.0) follower.follow(photon.start, power, points(i, 2), rng, deposit);
    return 0.0;
  });
  return result;
}

}  // namespace knotlight
