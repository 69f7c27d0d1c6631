#include "rivals/irradiance_tree.h"

#include <algorithm>
#include <array>

#include "core/mesh.h"

namespace knotlight {
namespace {

constexpr std::uint32_t leaf_points = 8;  // as in [JB02]; a cell of fewer is hardly cheaper
// Points nearer to each other than 2^-32 of the extent are one to rounding of the sums.
constexpr int deepest = 32;
// Places summed at a time: enough to fill vector registers, few enough to stay in the first cache.
constexpr int batch = 256;

int octant(const Vec3& x, const Vec3& center) {
  return (x.x() >= center.x() ? 1 : 0) + (x.y() >= center.y() ? 2 : 0) +
         (x.z() >= center.z() ? 4 : 0);
}

// Adds terms of the sum in their order, a batch at a time.
class BatchedSum {
 public:
  explicit BatchedSum(const DipoleKernel& kernel) : kernel_(kernel) {}

  void add(double r2, double power) {
    r2_[used_] = r2;
    powers_[used_] = power;
    if (++used_ == batch) flush();
  }
  double total() {
    flush();
    return sum_;
  }

 private:
  void flush() {
    if (used_ > 0) sum_ += kernel_.sum(r2_.data(), powers_.data(), static_cast<int>(used_));
    used_ = 0;
  }

  const DipoleKernel& kernel_;
  std::array<double, batch> r2_;
  std::array<double, batch> powers_;
  std::size_t used_ = 0;
  double sum_ = 0.0;
};

}  // namespace

IrradianceTree::IrradianceTree(std::vector<EnteringLight> points) : points_(std::move(points)) {
  std::erase_if(points_, [](const EnteringLight& point) { return point.power == 0.0; });
  if (points_.empty()) return;
  Bounds box;
  for (const EnteringLight& point : points_) box.extend(point.position);
  build(0, static_cast<std::uint32_t>(points_.size()), box.center(), 0.5 * box.largest_extent(), 0);
}

void IrradianceTree::build(std::uint32_t first, std::uint32_t count, const Vec3& center,
                           double half, int depth) {
  const std::size_t index = nodes_.size();
  Node node;
  node.cell_center = center;
  node.cell_half = half;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const EnteringLight& point = points_[i];
    node.power += point.power;
    node.area += point.area;
    node.center_of_power += point.power * point.position;
  }
  node.center_of_power /= node.power;
  nodes_.push_back(node);
  if (count <= leaf_points || depth == deepest) {
    nodes_[index].first = first;
    nodes_[index].count = count;
  } else {
    const auto begin = points_.begin() + first;
    std::stable_sort(begin, begin + count, [&](const EnteringLight& a, const EnteringLight& b) {
      return octant(a.position, center) < octant(b.position, center);
    });
    std::array<std::uint32_t, 8> counts{};
    for (std::uint32_t i = first; i < first + count; ++i)
      counts[static_cast<std::size_t>(octant(points_[i].position, center))] += 1;
    for (std::size_t o = 0; o < 8; ++o) {
      if (counts[o] == 0) continue;
      const Vec3 towards((o & 1U) != 0 ? 1.0 : -1.0, (o & 2U) != 0 ? 1.0 : -1.0,
                         (o & 4U) != 0 ? 1.0 : -1.0);
      build(first, counts[o], center + 0.5 * half * towards, 0.5 * half, depth + 1);
      first += counts[o];
    }
  }
  nodes_[index].skip = static_cast<std::uint32_t>(nodes_.size());
}

double IrradianceTree::exitance(const Vec3& x, const DipoleKernel& kernel,
                                double solid_angle) const {
  BatchedSum sum(kernel);
  for (std::size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    const double r2 = (x - node.center_of_power).squaredNorm();
    const bool within = ((x - node.cell_center).cwiseAbs().array() <= node.cell_half).all();
    if (!within && node.area <= solid_angle * r2) {
      sum.add(r2, node.power);
      i = node.skip;
      continue;
    }
    for (std::uint32_t p = node.first; p < node.first + node.count; ++p)
      sum.add((x - points_[p].position).squaredNorm(), points_[p].power);
    ++i;
  }
  return sum.total();
}

}  // namespace knotlight
