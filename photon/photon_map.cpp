#include "photon/photon_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "photon/ball_volume.h"
#include "photon/beams.h"
#include "photon/slope_fit.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Photons per leaf: between 8 and 32 the time of building plus searching hardly changes.
constexpr std::size_t leaf_size = 16;

// default_estimate: photons in a ball per square root of all, but not fewer than leave 15 % of
// noise, and the largest ball in mean free paths, beyond which the light of the rest of the object
// comes in.
constexpr double photons_per_root = 2.0;
constexpr std::size_t fewest_nearest = 50;
constexpr double largest_radius = 1.0;
// Refraction at a curved surface changes a beam's irradiance across the ball in ways that the
// estimate does not know: smaller balls, docs/results/estimators.md.
constexpr double largest_radius_refracting = 0.5;

// nanoflann's view of the photons.
struct PhotonCloud {
  std::vector<VolumePhoton> photons;

  std::size_t kdtree_get_point_count() const { return photons.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t dimension) const {
    return photons[i].position[static_cast<Eigen::Index>(dimension)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // nanoflann computes it
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PhotonCloud>,
                                                 PhotonCloud, 3>;

// Along a Morton curve of 1024^3 cells: photons of one ball then lie near each other in memory,
// which makes an estimate from 2000 of a million a quarter faster.
void sort_along_curve(std::vector<VolumePhoton>& photons) {
  constexpr int bits = 10;
  Bounds box;
  for (const VolumePhoton& p : photons) box.extend(p.position);
  const double extent = box.largest_extent();
  const double scale = extent > 0.0 ? ((1 << bits) - 1) / extent : 0.0;
  std::vector<std::pair<std::uint32_t, std::size_t>> codes;
  codes.reserve(photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i) {
    std::uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell =
          static_cast<std::uint32_t>(scale * (photons[i].position[axis] - box.lo[axis]));
      for (int bit = 0; bit < bits; ++bit) code |= ((cell >> bit) & 1U) << (3 * bit + axis);
    }
    codes.emplace_back(code, i);
  }
  std::sort(codes.begin(), codes.end());
  std::vector<VolumePhoton> sorted;
  sorted.reserve(photons.size());
  for (const auto& [code, i] : codes) sorted.push_back(photons[i]);
  photons = std::move(sorted);
}

// The k nearest of what the tree offers, as a heap with the farthest on top: nanoflann's own list
// is kept sorted by insertion, which takes k^2/4 moves.
class NearestPhotons {
 public:
  using Entry = std::pair<double, std::size_t>;  // squared distance, index

  NearestPhotons(std::size_t k, double max_squared_distance)
      : k_(k), limit_(max_squared_distance) {}
  std::size_t size() const { return heap_.size(); }
  bool full() const { return heap_.size() == k_; }
  double worstDist() const { return full() ? heap_.front().first : limit_; }
  bool addPoint(double squared_distance, std::size_t index) {
    if (squared_distance >= worstDist()) return true;
    if (full()) {
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.back() = {squared_distance, index};
    } else {
      heap_.emplace_back(squared_distance, index);
    }
    std::push_heap(heap_.begin(), heap_.end());
    return true;
  }
  // Takes the farthest off.
  void drop_worst() {
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }
  const std::vector<Entry>& entries() const { return heap_; }

 private:
  std::size_t k_;
  double limit_;
  std::vector<Entry> heap_;
};

struct Neighbourhood {
  double radius;
  std::vector<std::size_t> indices;  // of the photons closer than the radius
};

Neighbourhood photons_around(const Vec3& x, double max_radius, const EstimateOptions& options,
                             const Tree& tree) {
  Neighbourhood ball{max_radius, {}};
  const bool all = options.estimator == DensityEstimator::radius;
  assert(all || options.nearest > 1);
  const std::size_t k = all ? std::numeric_limits<std::size_t>::max() : options.nearest;
  NearestPhotons found(k, max_radius * max_radius);
  tree.findNeighbors(found, x.data(), nanoflann::SearchParams());
  if (found.full()) {
    ball.radius = std::sqrt(found.worstDist());
    found.drop_worst();
  }
  for (const auto& entry : found.entries()) ball.indices.push_back(entry.second);
  return ball;
}

}  // namespace

EstimateOptions default_estimate(std::size_t photons, double ior) {
  EstimateOptions options;
  const double wanted = photons_per_root * std::sqrt(static_cast<double>(photons));
  options.nearest = std::max(fewest_nearest, static_cast<std::size_t>(std::lround(wanted)));
  options.max_radius = ior == 1.0 ? largest_radius : largest_radius_refracting;
  return options;
}

struct VolumePhotonMap::Implementation {
  PhotonCloud cloud;
  Medium medium;
  bool first_order_only = true;
  double total_power = 0.0;
  std::unique_ptr<Tree> tree;  // null if there are no photons
};

VolumePhotonMap::VolumePhotonMap(std::vector<VolumePhoton> photons, const Medium& medium,
                                 bool first_order_only)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  self.medium = medium;
  self.first_order_only = first_order_only;
  self.cloud.photons = std::move(photons);
  if (first_order_only)
    std::erase_if(self.cloud.photons, [](const VolumePhoton& p) { return p.order != 1; });
  sort_along_curve(self.cloud.photons);
  for (const VolumePhoton& p : self.cloud.photons) self.total_power += p.power;
  if (!self.cloud.photons.empty())
    self.tree =
        std::make_unique<Tree>(3, self.cloud, nanoflann::KDTreeSingleIndexAdaptorParams(leaf_size));
}

VolumePhotonMap::~VolumePhotonMap() = default;
VolumePhotonMap::VolumePhotonMap(VolumePhotonMap&&) noexcept = default;
VolumePhotonMap& VolumePhotonMap::operator=(VolumePhotonMap&&) noexcept = default;

std::size_t VolumePhotonMap::size() const {
  return implementation_->cloud.photons.size();
}

const std::vector<VolumePhoton>& VolumePhotonMap::photons() const {
  return implementation_->cloud.photons;
}

double VolumePhotonMap::total_power() const {
  return implementation_->total_power;
}

ReducedIncident VolumePhotonMap::estimate(const Vec3& x, const EstimateOptions& options,
                                          const RayCaster& caster, std::uint32_t object) const {
  const Implementation& self = *implementation_;
  if (!self.tree) return {};
  const Medium& medium = self.medium;
  const double sigma_t = medium.sigma_t();
  const bool undo = options.undo_attenuation && self.first_order_only;
  const Neighbourhood ball = photons_around(x, options.max_radius / sigma_t, options, *self.tree);
  const RadialKernel kernel =
      options.estimator == DensityEstimator::kernel ? RadialKernel::smooth : RadialKernel::ball;
  const auto weight_of = [&](const VolumePhoton& p) {
    return p.power *
           kernel_value(kernel, (p.position - x).squaredNorm() / (ball.radius * ball.radius));
  };
  // Sums over photons p, w/V their weight over the kernel's mass: of w/V, its square, w/V
  // direction.
  double density = 0.0;
  double variance = 0.0;
  Vec3 moment = Vec3::Zero();

  Beams found;
  if (options.beams && undo) {
    std::vector<Vec3> directions;
    std::vector<Vec3> offsets;
    for (const std::size_t i : ball.indices) {
      directions.push_back(self.cloud.photons[i].direction);
      offsets.push_back(self.cloud.photons[i].position - x);
    }
    found = find_beams(directions, offsets);
  } else {
    found.others.resize(ball.indices.size());
    std::iota(found.others.begin(), found.others.end(), std::size_t{0});
  }
  for (const Beam& beam : found.beams) {
    const double mass =
        beam_mass(x, beam, ball.radius, kernel, sigma_t, medium.ior == 1.0, caster, object);
    for (const std::size_t i : beam.members) {
      const VolumePhoton& p = self.cloud.photons[ball.indices[i]];
      const double part = weight_of(p) / mass;
      density += part;
      variance += part * part;
      // The direction of the beam's ray through x, where the photon's own is one through itself.
      const Vec3 u = p.position - x;
      moment += part * (p.direction - beam.spread * (u - u.dot(beam.direction) * beam.direction));
    }
  }
  if (!found.others.empty()) {
    LocalPhotons local;
    for (const std::size_t i : found.others) {
      const VolumePhoton& p = self.cloud.photons[ball.indices[i]];
      const Vec3 u = p.position - x;
      local.offsets.push_back(u / ball.radius);
      local.weights.push_back(weight_of(p) * (undo ? std::exp(sigma_t * p.direction.dot(u)) : 1.0));
    }
    const KernelMoments inside = kernel_moments_inside(x, ball.radius, kernel, caster, object);
    const double error = options.fit_slope
                             ? carry_along_slope(local, inside.first / (inside.mass * ball.radius))
                             : relative_error_of_sum(local.weights);
    double sum = 0.0;
    for (std::size_t i = 0; i < found.others.size(); ++i) {
      sum += local.weights[i] / inside.mass;
      moment += local.weights[i] / inside.mass *
                self.cloud.photons[ball.indices[found.others[i]]].direction;
    }
    density += sum;
    variance += error * error * sum * sum;
  }
  ReducedIncident result;
  result.U_ri = density / (4.0 * pi * sigma_t);
  result.Q_ri = medium.g * medium.albedo() * moment;
  result.relative_standard_error = ball.indices.empty() ? std::numeric_limits<double>::infinity()
                                                        : std::sqrt(variance) / density;
  return result;
}

}  // namespace knotlight
