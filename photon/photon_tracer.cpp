#include "photon/photon_tracer.h"

#include <algorithm>

#include "photon/emission.h"
#include "photon/photon_walk.h"

namespace knotlight {
namespace {

// Photons per batch: the unit of work of a thread and of the spread behind standard errors.
constexpr std::size_t largest_batch = 4096;
// Few photons still make this many batches: the spread over 64 is known to 9 %.
constexpr std::size_t wanted_batches = 64;

// Light that comes back is a smaller and smoother part of the source than the first light, so a
// quarter of the paths carries it with as little noise.
constexpr double reentering_share = 0.25;

}  // namespace

TraceResult trace_photons(const Scene& scene, const RayCaster& caster, int channel,
                          const TracerOptions& options, const Workers& workers, Stage& stage) {
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
  if (!emitter.any() || options.photons == 0) return result;

  const std::size_t batch_size =
      std::clamp<std::size_t>(options.photons / wanted_batches, 1, largest_batch);
  const std::size_t batches = (options.photons + batch_size - 1) / batch_size;
  std::vector<WalkRecord> records(batches);
  std::vector<double> emitted(batches, 0.0);
  std::vector<std::size_t> sizes(batches);
  workers.for_chunks(options.photons, batch_size,
                     [&](std::size_t batch, std::size_t begin, std::size_t end) {
                       WalkRecord record{std::vector<std::vector<VolumePhoton>>(objects),
                                         std::vector<PowerTally>(objects)};
                       for (std::size_t i = begin; i < end; ++i) {
                         Rng rng(options.seed, Stream::photons, i);
                         EmittedPhoton photon = emitter.sample(rng);
                         photon.power /= static_cast<double>(options.photons);
                         if (photon.power == 0.0) continue;
                         emitted[batch] += photon.power;
                         walk.run(photon, rng, record);
                       }
                       sizes[batch] = end - begin;
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
