#include "bkm/charge_order.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace knotlight {
namespace {

constexpr std::size_t groups_per_chunk = 1 << 17;  // few, since each has its own count of buckets
constexpr std::size_t buckets_per_chunk = 512;
constexpr int bucket_levels = 6;  // cells of the octree whose charges are brought together first
constexpr std::size_t buckets = 1U << 3 * bucket_levels;

struct Extent {
  Vec3 lo = Vec3::Constant(1e300);
  Vec3 hi = Vec3::Constant(-1e300);
  double largest_strength = 0.0;
  std::size_t charges = 0;
};

template <class Visit>
void for_charges(const ChargeSource& source, std::size_t begin, std::size_t end, Visit visit) {
  std::array<PointCharge, ChargeSource::largest_group> group;
  for (std::size_t g = begin; g < end; ++g) {
    const int count = source.charges(g, group.data());
    for (int i = 0; i < count; ++i) {
      const PointCharge& charge = group[static_cast<std::size_t>(i)];
      if (charge.strength != 0.0) visit(charge);
    }
  }
}

Extent extent_of(const ChargeSource& source, std::size_t begin, std::size_t end) {
  Extent extent;
  for_charges(source, begin, end, [&](const PointCharge& charge) {
    if (!charge.position.allFinite() || !std::isfinite(charge.strength))
      throw std::invalid_argument("point charges: positions and strengths must be finite");
    extent.lo = extent.lo.cwiseMin(charge.position);
    extent.hi = extent.hi.cwiseMax(charge.position);
    extent.largest_strength = std::max(extent.largest_strength, std::abs(charge.strength));
    ++extent.charges;
  });
  return extent;
}

std::uint32_t fixed_point(double x) {
  constexpr double largest = 4294967295.0;
  return static_cast<std::uint32_t>(std::clamp(x * 4294967296.0, 0.0, largest));
}

std::size_t bucket_of(const OrderedCharge& charge) {
  std::size_t bucket = 0;
  for (int level = 0; level < bucket_levels; ++level)
    bucket = bucket << 3U | static_cast<std::size_t>(charge.octant(level));
  return bucket;
}

// Brings the charges of each part of a cell together, level by level, as long as there are more
// than a leaf may have. Charges of one leaf stay in the order in which they came.
void order_cell(OrderedCharge* begin, std::size_t count, int level,
                std::vector<OrderedCharge>& scratch) {
  if (count <= leaf_charges || level == octree_levels) return;
  std::array<std::size_t, 9> first{};
  for (std::size_t i = 0; i < count; ++i)
    ++first[static_cast<std::size_t>(begin[i].octant(level)) + 1];
  for (std::size_t octant = 0; octant < 8; ++octant) first[octant + 1] += first[octant];
  std::array<std::size_t, 9> next = first;
  scratch.assign(begin, begin + count);
  for (const OrderedCharge& charge : scratch)
    begin[next[static_cast<std::size_t>(charge.octant(level))]++] = charge;
  for (std::size_t octant = 0; octant < 8; ++octant)
    order_cell(begin + first[octant], first[octant + 1] - first[octant], level + 1, scratch);
}

}  // namespace

std::vector<OrderedCharge> order_charges(const ChargeSource& source, ChargeTree& tree,
                                         const Workers& workers) {
  const std::size_t chunks = (source.groups + groups_per_chunk - 1) / groups_per_chunk;
  std::vector<Extent> extents(chunks);
  workers.for_chunks(source.groups, groups_per_chunk,
                     [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                       extents[chunk] = extent_of(source, begin, end);
                     });
  Extent all;
  std::vector<std::size_t> first_of_chunk;
  for (const Extent& extent : extents) {
    first_of_chunk.push_back(all.charges);
    all.charges += extent.charges;
    all.lo = all.lo.cwiseMin(extent.lo);
    all.hi = all.hi.cwiseMax(extent.hi);
    all.largest_strength = std::max(all.largest_strength, extent.largest_strength);
  }
  if (all.charges == 0) return {};
  const double edge = (all.hi - all.lo).maxCoeff();
  tree.origin = all.lo;
  tree.unit = edge > 0.0 ? edge : 1.0;  // one charge alone: any unit will do
  tree.strength_unit = all.largest_strength;

  // Each chunk counts its charges per bucket; with the counts of those before it, every charge has
  // its place without regard to which thread moves it there.
  std::vector<OrderedCharge> unordered(all.charges);
  std::vector<std::vector<std::uint32_t>> places(chunks);
  workers.for_chunks(
      source.groups, groups_per_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        places[chunk].assign(buckets, 0);
        std::size_t i = first_of_chunk[chunk];
        for_charges(source, begin, end, [&](const PointCharge& charge) {
          const Vec3 p = (charge.position - tree.origin) / tree.unit;
          unordered[i] = {{fixed_point(p.x()), fixed_point(p.y()), fixed_point(p.z())},
                          static_cast<float>(charge.strength / tree.strength_unit)};
          ++places[chunk][bucket_of(unordered[i++])];
        });
      });
  std::vector<std::uint32_t> first_of_bucket(buckets + 1);
  std::uint32_t place = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    first_of_bucket[bucket] = place;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk)
      place += std::exchange(places[chunk][bucket], place);
  }
  first_of_bucket[buckets] = place;

  std::vector<OrderedCharge> ordered(all.charges);
  workers.for_chunks(chunks, 1, [&](std::size_t chunk, std::size_t, std::size_t) {
    const std::size_t end = chunk + 1 < chunks ? first_of_chunk[chunk + 1] : all.charges;
    for (std::size_t i = first_of_chunk[chunk]; i < end; ++i)
      ordered[places[chunk][bucket_of(unordered[i])]++] = unordered[i];
  });
  workers.for_chunks(
      buckets, buckets_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        std::vector<OrderedCharge> scratch;
        for (std::size_t bucket = begin; bucket < end; ++bucket)
          order_cell(ordered.data() + first_of_bucket[bucket],
                     first_of_bucket[bucket + 1] - first_of_bucket[bucket], bucket_levels, scratch);
      });
  return ordered;
}

}  // namespace knotlight
