#include "pipeline/boundary_knots.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace knotlight {
namespace {

// Rays per knot and half to lights of some extent, with the model boundary_flux alone: a patch
// averages over dozens of knots.
constexpr int rays_per_knot = 64;

// Where two points count as one: nothing lies between them, and no ray has a direction there.
constexpr double coincident = 1e-9;  // of the object's size

}  // namespace

SpreadKnots spread_surface_knots(const Shape& shape, std::size_t count, std::uint64_t seed) {
  const std::vector<SurfacePoint> strata =
      stratified_surface_points(shape, count, true, seed, Stream::boundary_knots);
  const std::size_t n = strata.size();
  const int bits = static_cast<int>(std::bit_width(n - 1));
  SpreadKnots knots{Points(3, static_cast<Eigen::Index>(n)),
                    Points(3, static_cast<Eigen::Index>(n)), surface_area(shape)};
  Eigen::Index next = 0;
  for (std::size_t i = 0; next < knots.positions.cols(); ++i) {
    std::size_t reversed = 0;
    for (int b = 0; b < bits; ++b) reversed |= ((i >> b) & 1U) << (bits - 1 - b);
    if (reversed >= n) continue;
    knots.positions.col(next) = strata[reversed].position;
    knots.normals.col(next++) = strata[reversed].normal;
  }
  return knots;
}

BodyQueries body_queries(const ChannelProblem& p) {
  const RayCaster& caster = p.caster;
  const std::uint32_t object = p.object;
  const double same = coincident * bounds(p.shape).radius();
  BodyQueries body;
  body.inside = [&caster, object](const Vec3& x) { return caster.inside(x, object); };
  body.connected = [&caster, object, same](const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double length = d.norm();
    if (length <= same) return true;
    const auto hit = caster.nearest({a, d / length, length}, object);
    return !hit || hit->t >= length - caster.touching_distance();
  };
  body.thickness = [&caster, object](const Vec3& x, const Vec3& inward) {
    const auto hit = caster.nearest({x, inward}, object);
    return hit ? hit->t : 0.0;
  };
  return body;
}

BoundaryData boundary_data(const ChannelProblem& p, const ParticularValues& up,
                           const SurfaceSamples& at, std::uint64_t seed) {
  BoundaryData data;
  for (std::size_t half = 0; half < 2; ++half) {
    data.g[half] =
        up.surface_data[half] - (up.value[half] + p.coefficients.k * up.normal_derivative[half]);
    if (p.light.model != SourceModel::boundary_flux) continue;
    const Eigen::VectorXd light = entering_irradiances(p.scene, p.caster, p.channel, p.object, at,
                                                       rays_per_knot, seed + half, p.workers);
    for (Eigen::Index i = 0; i < light.size(); ++i)
      data.g[half][i] += p.coefficients.boundary_flux_data(light[i]);
  }
  return data;
}

}  // namespace knotlight
