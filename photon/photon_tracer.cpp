#include "photon/photon_tracer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "photon/emission.h"
#include "photon/photon_walk.h"
#include "photon/surroundings_light.h"
#include "photon/volume_emission.h"

namespace knotlight {
namespace {

// The unit of work of a thread and of the spread behind standard errors, which over so many batches
// is known to 4 %.
constexpr std::size_t wanted_batches = 256;

// Light that comes back is a smaller and smoother part of the source than the first light, so a
// quarter of the paths carries it with as little noise.
constexpr double reentering_share = 0.25;

// Above the numbers of first_light_tracer.cpp under the same seed.
constexpr std::uint64_t first_surroundings_walk = std::uint64_t{1} << 63U;

// As many as carry about the power of the lights' photons each, at most as many as those.
std::size_t photons_for(double power, double power_of_lights, std::size_t photons) {
  if (power == 0.0) return 0;
  const double share = std::min(1.0, power / power_of_lights);
  return static_cast<std::size_t>(std::ceil(share * static_cast<double>(photons)));
}

// Takes the batches of all threads and hands them on in their order, so that sums have the same
// bits for any number of threads. What waits is about one batch per thread.
class InOrder {
 public:
  explicit InOrder(std::span<FluxTally> tallies) : tallies_(tallies) {}

  void add(std::size_t batch, std::vector<FluxSums> sums) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(batch, std::move(sums));
    for (auto next = waiting_.find(next_); next != waiting_.end(); next = waiting_.find(next_)) {
      for (std::size_t i = 0; i < tallies_.size(); ++i) tallies_[i].add(next->second[i]);
      waiting_.erase(next);
      ++next_;
    }
  }

 private:
  std::span<FluxTally> tallies_;
  std::mutex mutex_;
  std::map<std::size_t, std::vector<FluxSums>> waiting_;
  std::size_t next_ = 0;
};

}  // namespace

TraceResult trace_photons(const Scene& scene, const RayCaster& caster, int channel,
                          const TracerOptions& options, const Workers& workers, Stage& stage,
                          std::span<FluxTally> fluxes) {
  const std::size_t objects = scene.objects.size();
  TraceResult result;
  result.photons.resize(objects);
  result.audit.resize(objects);
  using Orders = TracerOptions::Orders;
  const double follow = options.orders == Orders::first        ? 0.0
                        : options.orders == Orders::reentering ? reentering_share
                                                               : 1.0;
  const PhotonWalk walk(scene, caster, channel,
                        {follow, options.store,
                         options.orders == Orders::reentering || options.orders == Orders::returned,
                         options.orders == Orders::returned});
  if (!walk.passage().target()) return result;
  const Emitter emitter(scene.lights, channel, *walk.passage().target(),
                        walk.passage().scene_bounds());
  const SurroundingsLight surroundings(scene, caster, walk.passage());
  if (options.photons == 0) return result;
  const VolumeEmission emission(scene, caster, channel);
  const bool follows_emission =
      options.orders == Orders::reentering || options.orders == Orders::returned;
  const std::size_t emitted_inside =
      follows_emission ? photons_for(emission.power(), emitter.power(), options.photons) : 0;
  const std::size_t reflected = surroundings.photons_beside(emitter, channel, options.photons);

  const std::size_t batches = std::min(options.photons, wanted_batches);
  std::vector<WalkRecord> records(batches);
  std::vector<double> emitted(batches, 0.0);
  std::vector<std::size_t> sizes(batches);
  InOrder flux_batches(fluxes);
  workers.for_chunks(batches, 1, [&](std::size_t batch, std::size_t, std::size_t) {
    WalkRecord record{
        std::vector<std::vector<VolumePhoton>>(objects), std::vector<PowerTally>(objects), {}};
    for (const FluxTally& flux : fluxes) record.fluxes.push_back(flux.batch());
    // Sizes differ by one at most.
    const std::size_t begin = options.photons * batch / batches;
    const std::size_t end = options.photons * (batch + 1) / batches;
    for (std::size_t i = begin; i < end && emitter.any(); ++i) {
      Rng rng(options.seed, Stream::photons, i);
      EmittedPhoton photon = emitter.sample(rng);
      photon.power /= static_cast<double>(options.photons);
      if (photon.power == 0.0) continue;
      emitted[batch] += photon.power;
      walk.run(photon, rng, record);
    }
    for (std::size_t i = reflected * batch / batches; i < reflected * (batch + 1) / batches; ++i) {
      Rng rng(options.seed, Stream::surroundings, first_surroundings_walk + i);
      std::array<double, 4> u{};
      for (double& number : u) number = rng.uniform();
      const SurroundingsLight::Photon photon = surroundings.sample(u, rng);
      const double power = photon.power[channel] / static_cast<double>(reflected);
      if (power > 0.0) walk.run(photon.start, power, rng, record);
    }
    const auto own = [&](std::size_t b) { return emitted_inside * b / batches; };
    for (std::size_t i = own(batch); i < own(batch + 1); ++i) {
      Rng rng(options.seed, Stream::volume_emission, i);
      VolumeEmission::Photon photon = emission.sample(rng);
      photon.photon.power /= static_cast<double>(emitted_inside);
      walk.run_emitted(photon.photon, photon.object, rng, record);
    }
    sizes[batch] = end - begin;
    flux_batches.add(batch, std::move(record.fluxes));
    records[batch] = std::move(record);
    stage.advance(end - begin);
  });

  for (const double power : emitted) result.emitted += power;
  for (std::size_t object = 0; object < objects; ++object) {
    std::size_t total = 0;
    std::vector<PowerTally> tallies;
    for (const WalkRecord& record : records) {
      total += record.photons[object].size();
      tallies.push_back(record.tally[object]);
    }
    result.audit[object] = energy_audit(tallies, sizes);
    result.photons[object].reserve(total);
    for (WalkRecord& record : records) {
      std::vector<VolumePhoton> part = std::move(record.photons[object]);  // freed as we go
      result.photons[object].insert(result.photons[object].end(), part.begin(), part.end());
    }
  }
  return result;
}

}  // namespace knotlight
