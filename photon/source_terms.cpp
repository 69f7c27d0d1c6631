#include "photon/source_terms.h"

#include <numbers>
#include <vector>

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr std::size_t terms_per_chunk = 32;  // some milliseconds of work

// div Q_ri at x by central differences of the estimate as the thesis has it: with the attenuation
// undone, a photon's weight would carry the known derivative into the difference.
double differentiated_divergence(const Vec3& x, const VolumePhotonMap& map, const Medium& medium,
                                 const SourceTermOptions& options, const RayCaster& caster,
                                 std::uint32_t object) {
  EstimateOptions plain = options.estimate;
  plain.undo_attenuation = false;
  plain.fit_slope = false;
  const double h = options.difference_step / medium.sigma_t();
  const SurfacePoint surface = caster.nearest_surface_point(x, object);
  const bool near_surface = (x - surface.position).norm() < h;
  const Vec3 center = near_surface ? Vec3(surface.position - h * surface.normal) : x;
  // Along the normal and across it, so that near a plane no point lies outside.
  const Frame frame(surface.normal);
  double divergence = 0.0;
  for (const Vec3& axis : {frame.t, frame.b, frame.n}) {
    const Vec3 ahead = map.estimate(center + h * axis, plain, caster, object).Q_ri;
    const Vec3 behind = map.estimate(center - h * axis, plain, caster, object).Q_ri;
    divergence += (ahead - behind).dot(axis) / (2.0 * h);
  }
  return divergence;
}

double f_from(const ReducedIncident& light, const Vec3& x, const VolumePhotonMap& map,
              const Medium& medium, const DiffusionCoefficients& c,
              const SourceTermOptions& options, const RayCaster& caster, std::uint32_t object) {
  const double emitted = c.source_per_E * medium.emission;
  if (options.divergence == Divergence::identity) return c.source_per_U_ri * light.U_ri + emitted;
  const double scattered = -3.0 * medium.sigma_s * c.sigma_tr * light.U_ri;
  if (map.size() == 0) return scattered + emitted;
  return scattered + emitted +
         3.0 / (4.0 * pi) * differentiated_divergence(x, map, medium, options, caster, object);
}

}  // namespace

double source_term(const Vec3& x, const VolumePhotonMap& map, const Medium& medium,
                   const SourceTermOptions& options, const RayCaster& caster,
                   std::uint32_t object) {
  const DiffusionCoefficients c = diffusion_coefficients(medium, options.boundary);
  const ReducedIncident light = map.estimate(x, options.estimate, caster, object);
  return f_from(light, x, map, medium, c, options, caster, object);
}

SourceTerms source_terms(const Points& boundary_points, const Points& boundary_normals,
                         const Points& interior_points, const VolumePhotonMap& map,
                         const Medium& medium, const SourceTermOptions& options,
                         const RayCaster& caster, std::uint32_t object, const Workers& workers) {
  const Eigen::Index n = boundary_points.cols();
  const Eigen::Index total = n + interior_points.cols();
  const DiffusionCoefficients c = diffusion_coefficients(medium, options.boundary);
  SourceTerms terms{Eigen::VectorXd(total), Eigen::VectorXd(n), Eigen::VectorXd(total)};
  std::vector<double> errors(static_cast<std::size_t>(total));
  workers.for_chunks(
      static_cast<std::size_t>(total), terms_per_chunk,
      [&](std::size_t, std::size_t begin, std::size_t end) {
        for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
          const Vec3 x = i < n ? boundary_points.col(i) : interior_points.col(i - n);
          const ReducedIncident light = map.estimate(x, options.estimate, caster, object);
          terms.U_ri[i] = light.U_ri;
          errors[static_cast<std::size_t>(i)] = light.relative_standard_error;
          terms.f[i] = f_from(light, x, map, medium, c, options, caster, object);
          if (i < n) terms.g[i] = c.robin_data(light.Q_ri.dot(boundary_normals.col(i)));
        }
      });
  for (const double error : errors)
    terms.mean_relative_error += error / static_cast<double>(errors.size());
  return terms;
}

}  // namespace knotlight
