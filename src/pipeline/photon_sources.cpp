#include "pipeline/photon_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bkm/robin_image.h"
#include "pipeline/grid_load.h"
#include "pipeline/tangent_planes.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr std::size_t charges_per_chunk = 1024;  // about a millisecond of searching

// Ends of flights are charges on the surface, and a point of the surface has some of them very
// near: 1/r has no variance there. Spread out over this many mean distances between them, with what
// they are spread by at most half of k, they are an even layer.
constexpr double end_spread = 2.0;
constexpr double widest_end = 0.5;
// With less room above the surface than this part of that height the layer would be spikes.
constexpr double least_room = 0.25;

// The two charges of a dipole are this far apart, in mean free paths, or as far as the surface is
// away, if that is less: by Taylor's series it changes the source by a share of 0.25^2/24, 0.3 %.
constexpr double dipole_length = 0.25;
constexpr double least_dipole_length = 1e-3;  // of a photon on the surface

// Strengths as in grid_load.cpp: docs/theory.md (12) and (13b).
struct Strengths {
  explicit Strengths(const Medium& m)
      : charge(3.0 * m.sigma_s * m.sigma_tr() / (4.0 * pi * m.sigma_t())),
        moment(3.0 / (4.0 * pi) * m.g * m.sigma_s / m.sigma_t()) {}

  double charge;  // per power of a photon, 1/(length sr)
  double moment;  // per power, along its direction, 1/sr
};

struct Charge {
  Vec3 position;
  double strength;
  double height = 0.0;  // above its plane at which it is to stand, if it is a flight's end there
};

double end_height(const IncidentHalf& half, const ChannelProblem& p) {
  const double each = surface_area(p.shape) / std::max(1.0, static_cast<double>(half.ends.size()));
  return std::min(end_spread * std::sqrt(each), widest_end * p.coefficients.k);
}

std::vector<Charge> charges_of(const IncidentHalf& half, const ChannelProblem& p,
                               const TangentPlanes& planes) {
  const Medium& m = p.medium;
  const Strengths strengths(m);
  std::vector<Charge> charges;
  for (std::size_t i = 0; i < half.expected; ++i)
    charges.push_back(
        {half.photons[i].position,
         (strengths.charge + strengths.moment * m.sigma_t()) * half.photons[i].power});
  const double height = end_height(half, p);
  for (const FlightEnd& end : half.ends)
    charges.push_back({end.position, strengths.moment * m.sigma_t() * end.power,
                       end.normal.isZero() ? 0.0 : height});
  for (std::size_t i = half.expected; i < half.photons.size(); ++i) {
    const VolumePhoton& photon = half.photons[i];
    const double charge = strengths.charge * photon.power;
    if (strengths.moment == 0.0) {
      charges.push_back({photon.position, charge});
      continue;
    }
    // w . grad v of the weak form as a difference of v.
    const double depth = (planes.nearest_to(photon.position).point - photon.position).norm();
    const double length =
        std::max(std::min(dipole_length / m.sigma_t(), depth), least_dipole_length / m.sigma_t());
    const double pole = strengths.moment * photon.power / length;
    const Vec3 arm = 0.5 * length * photon.direction;
    charges.push_back({photon.position + arm, 0.5 * charge + pole});
    charges.push_back({photon.position - arm, 0.5 * charge - pole});
  }
  if (p.light.model == SourceModel::irradiance_sampling)
    for (const PointSource& source : sources_below(half.irradiance, m, p.caster, p.object))
      charges.push_back({source.position, source.strength});
  return charges;
}

// Neighbours after each other: searches then find the mesh in the cache, twice as fast.
void order_by_place(std::vector<Charge>& charges, const Shape& shape) {
  constexpr double cells = 64.0;
  const Bounds box = bounds(shape);
  const double scale = cells / box.largest_extent();
  std::vector<std::pair<std::uint64_t, std::size_t>> order(charges.size());
  for (std::size_t i = 0; i < charges.size(); ++i) {
    const Vec3 place = ((charges[i].position - box.lo) * scale).cwiseMax(0.0).cwiseMin(cells);
    const auto key = place.cast<std::uint64_t>();
    order[i] = {(key.x() << 7U | key.y()) << 7U | key.z(), i};
  }
  std::sort(order.begin(), order.end());
  std::vector<Charge> ordered;
  ordered.reserve(charges.size());
  for (const auto& [key, i] : order) ordered.push_back(charges[i]);
  charges = std::move(ordered);
}

// A flight's end to the height above its plane at which it stands for a layer there. Where there is
// no room for that it stands as far below the surface instead, as a charge like any other.
void raise_end(Charge& end, const TangentPlane& plane, double clear, double lambda) {
  if (clear < least_room * end.height) {
    end.position = plane.point - end.height * plane.normal;
    return;
  }
  end.height = std::min(end.height, clear);
  end.position = plane.point + end.height * plane.normal;
  end.strength *= std::exp(lambda * end.height);
}

}  // namespace

PointSources photon_sources(const ChannelProblem& p, int half) {
  const double k = p.coefficients.k;
  const TangentPlanes planes(p.shape, p.caster, p.object, k);
  std::vector<Charge> charges =
      charges_of(p.light.halves[static_cast<std::size_t>(half)], p, planes);
  order_by_place(charges, p.shape);
  std::vector<TangentPlane> nearest(charges.size());
  p.workers.for_chunks(charges.size(), charges_per_chunk,
                       [&](std::size_t, std::size_t begin, std::size_t end) {
                         for (std::size_t i = begin; i < end; ++i)
                           nearest[i] = planes.nearest_to(charges[i].position);
                       });
  const std::vector<double> clear = planes.clear_heights(nearest, p.workers);

  const auto n = static_cast<Eigen::Index>(charges.size());
  PointSources sources;
  sources.positions.resize(3, n);
  sources.strengths.resize(n);
  sources.plane_points.resize(3, n);
  sources.plane_normals.resize(3, n);
  sources.clear_heights.resize(n);
  p.workers.for_chunks(
      charges.size(), charges_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto column = static_cast<Eigen::Index>(i);
          const bool is_end = charges[i].height > 0.0;
          if (is_end) raise_end(charges[i], nearest[i], clear[i], p.coefficients.lambda);
          sources.positions.col(column) = charges[i].position;
          sources.strengths[column] = charges[i].strength;
          sources.plane_points.col(column) = nearest[i].point;
          sources.plane_normals.col(column) = nearest[i].normal;
          // A charge inside that a rounded-off normal sees above its plane
          // has no image; only ends of flights stand there by intent.
          const bool askew =
              !is_end && (charges[i].position - nearest[i].point).dot(nearest[i].normal) > 0.0;
          sources.clear_heights[column] = askew ? -1.0 : clear[i];
        }
      });
  return sources;
}

}  // namespace knotlight
