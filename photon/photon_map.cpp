#include "photon/photon_map.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <numbers>
#include <utility>

#include "photon/ball_volume.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Photons per leaf: between 8 and 32 the time of building plus searching hardly changes.
constexpr std::size_t leaf_size = 16;

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

}  // namespace

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
  assert(options.nearest > 1);
  const Implementation& self = *implementation_;
  if (!self.tree) return {};
  const Medium& medium = self.medium;
  const double sigma_t = medium.sigma_t();
  double radius = options.max_radius / sigma_t;

  std::vector<std::size_t> indices(options.nearest);
  std::vector<double> squared_distances(options.nearest);
  nanoflann::KNNResultSet<double> found(options.nearest);
  found.init(indices.data(), squared_distances.data());
  squared_distances.back() = radius * radius;  // the search never looks further than this
  self.tree->findNeighbors(found, x.data(), nanoflann::SearchParams());
  std::size_t count = found.size();
  if (found.full()) {
    radius = std::sqrt(squared_distances.back());
    count -= 1;
  }

  double power = 0.0;
  double squares = 0.0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const VolumePhoton& p = self.cloud.photons[indices[i]];
    double weighted = p.power;
    if (options.undo_attenuation && self.first_order_only)
      weighted *= std::exp(sigma_t * p.direction.dot(p.position - x));
    power += weighted;
    squares += weighted * weighted;
    moment += weighted * p.direction;
  }
  const double volume = ball_volume_inside(x, radius, caster, object);
  ReducedIncident result;
  result.U_ri = power / (4.0 * pi * sigma_t * volume);
  result.Q_ri = medium.g * medium.albedo() / volume * moment;
  result.relative_standard_error =
      count > 0 ? std::sqrt(squares) / power : std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace knotlight
