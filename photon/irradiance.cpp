#include "photon/irradiance.h"

#include "trace/direct_light.h"

namespace knotlight {
namespace {

constexpr std::size_t irradiances_per_chunk = 256;  // about a millisecond of rays

}  // namespace

double entering_irradiance(const Scene& scene, const RayCaster& caster, int channel,
                           std::uint32_t object, const SurfacePoint& at, int rays, Rng& rng) {
  const double ior = scene.objects[object].translucent()->ior;
  return mean_irradiance(scene, caster, at.position, at.normal, rays, rng, ior)[channel];
}

Eigen::VectorXd entering_irradiances(const Scene& scene, const RayCaster& caster, int channel,
                                     std::uint32_t object, const SurfaceSamples& at, int rays,
                                     std::uint64_t seed, const Workers& workers) {
  Eigen::VectorXd values(at.positions.cols());
  workers.for_chunks(static_cast<std::size_t>(values.size()), irradiances_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) {
                         const auto column = static_cast<Eigen::Index>(i);
                         Rng rng(seed, Stream::irradiance_rays, i);
                         values[column] = entering_irradiance(
                             scene, caster, channel, object,
                             {at.positions.col(column), at.normals.col(column)}, rays, rng);
                       }
                     });
  return values;
}

std::vector<IrradianceSample> sample_irradiances(const Scene& scene, const RayCaster& caster,
                                                 int channel, std::uint32_t object,
                                                 std::size_t count, int rays, std::uint64_t seed,
                                                 std::uint64_t replicate, const Workers& workers) {
  const Shape& shape = scene.objects[object].shape;
  // Strata are keyed by the seed alone.
  Rng own(seed, Stream::irradiance_points, replicate);
  const std::uint64_t point_seed = own.next_u32();
  const std::vector<SurfacePoint> points =
      stratified_surface_points(shape, count, true, point_seed, Stream::irradiance_points);
  const double area = surface_area(shape) / static_cast<double>(points.size());
  std::vector<IrradianceSample> samples(points.size());
  workers.for_chunks(
      points.size(), irradiances_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          Rng rng(point_seed, Stream::irradiance_rays, i);
          samples[i] = {points[i], area,
                        entering_irradiance(scene, caster, channel, object, points[i], rays, rng)};
        }
      });
  return samples;
}

}  // namespace knotlight
