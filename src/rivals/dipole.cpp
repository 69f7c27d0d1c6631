#include "rivals/dipole.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "core/fresnel.h"
#include "photon/irradiance.h"
#include "photon/low_discrepancy.h"
#include "photon/surface_sampler.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr std::size_t points_per_chunk = 256;  // some milliseconds
// The shape, and the shadows on it, have to be seen also where mean free paths are long.
constexpr std::size_t fewest_samples = 5'000;

IrradianceTree light_entering(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                              int channel, const DipoleSettings& settings, std::size_t count,
                              std::uint64_t seed, const Workers& workers) {
  const SurfaceSampler surface({{object, &scene.objects[object].shape}});
  const LowDiscrepancy square(2, seed, object);
  std::vector<SurfacePoint> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    places.push_back(surface(square(i, 0), square(i, 1)).surface);
  const Eigen::VectorXd entered = entering_irradiances(
      scene, caster, channel, object, columns(places), settings.rays, seed, workers);
  const double area = surface.area() / static_cast<double>(count);
  std::vector<EnteringLight> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({places[i].position, area, area * entered[static_cast<Eigen::Index>(i)]});
  return IrradianceTree(std::move(points));
}

}  // namespace

DipoleSolution::DipoleSolution(const Scene& scene, const RayCaster& caster, std::uint32_t object,
                               int channel, const DipoleSettings& settings, std::uint64_t seed,
                               const Workers& workers)
    : solid_angle_(settings.solid_angle), tree_({}) {
  const Medium medium = scene.objects[object].translucent()->medium(channel);
  if (medium.emission > 0.0)
    throw InputError(
        fmt::format("object '{}': emits light, expected emission 0: the dipole knows only light "
                    "that enters through the surface",
                    scene.objects[object].name));
  A_ = diffuse_internal_reflection(medium.ior).A;
  kernel_ = dipole_kernel(medium, settings.form);
  const double squares =
      surface_area(scene.objects[object].shape) * medium.sigma_tr() * medium.sigma_tr();
  const double wanted = std::min(std::ceil(settings.samples_per_square * squares),
                                 static_cast<double>(settings.most_samples));
  const auto count = std::max(static_cast<std::size_t>(wanted), fewest_samples);
  spacing_ = std::sqrt(squares / static_cast<double>(count));
  tree_ = light_entering(scene, caster, object, channel, settings, count, seed, workers);
}

Eigen::VectorXd DipoleSolution::exitances(const Points& points, const Workers& workers) const {
  Eigen::VectorXd values(points.cols());
  workers.for_chunks(static_cast<std::size_t>(points.cols()), points_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) {
                         const auto column = static_cast<Eigen::Index>(i);
                         values[column] = tree_.exitance(points.col(column), kernel_, solid_angle_);
                       }
                     });
  return values;
}

Eigen::VectorXd DipoleSolution::mean_intensities(const Points& points,
                                                 const Workers& workers) const {
  return A_ / (2.0 * pi) * exitances(points, workers);
}

}  // namespace knotlight
