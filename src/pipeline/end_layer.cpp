#include "pipeline/end_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

// The same width as the layer that a raised charge looks like from below, so that little is left of
// the difference of both; it still averages over some 50 ends.
constexpr double radius_over_height = 2.0;
// Raised by less than this share of the largest height is rounding.
constexpr double least_height = 1e-6;
// Ends that face another way are on the far side of a thin part.
constexpr double least_cosine = -0.5;
constexpr std::size_t points_per_chunk = 64;
constexpr unsigned bits_per_axis = 21;

}  // namespace

EndLayer::EndLayer(const PointSources& sources, double lambda) {
  Eigen::VectorXd heights(sources.size());
  for (Eigen::Index i = 0; i < sources.size(); ++i)
    heights[i] =
        sources.plane_normals.col(i).dot(sources.positions.col(i) - sources.plane_points.col(i));
  heights = (sources.clear_heights.array() < 0.0).select(0.0, heights);  // no image: not raised
  const double highest = sources.size() == 0 ? 0.0 : heights.maxCoeff();
  if (!(highest > 0.0)) return;
  radius_ = radius_over_height * highest;
  lo_ = sources.plane_points.rowwise().minCoeff().array() - 2.0 * radius_;
  for (Eigen::Index i = 0; i < sources.size(); ++i)
    if (heights[i] > least_height * highest)
      ends_.push_back({cell_of(sources.plane_points.col(i), 0, 0, 0), sources.plane_points.col(i),
                       sources.plane_normals.col(i),
                       sources.strengths[i] * std::exp(-lambda * heights[i])});
  std::stable_sort(ends_.begin(), ends_.end(),
                   [](const End& a, const End& b) { return a.cell < b.cell; });
}

std::uint64_t EndLayer::cell_of(const Vec3& x, int dx, int dy, int dz) const {
  constexpr std::int64_t last = (1 << bits_per_axis) - 1;
  const Vec3 place = (x - lo_) / radius_;
  const auto along = [&](int axis, int step) {
    const double clamped = std::clamp(place[axis], 0.0, static_cast<double>(last));
    return static_cast<std::uint64_t>(
        std::clamp<std::int64_t>(static_cast<std::int64_t>(clamped) + step, 0, last));
  };
  return (along(0, dx) << bits_per_axis | along(1, dy)) << bits_per_axis | along(2, dz);
}

double EndLayer::density_at(const Vec3& x, const Vec3& normal) const {
  double sum = 0.0;
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy) {
      const std::uint64_t first = cell_of(x, dx, dy, -1), last = cell_of(x, dx, dy, 1);
      auto end = std::lower_bound(ends_.begin(), ends_.end(), first,
                                  [](const End& e, std::uint64_t cell) { return e.cell < cell; });
      for (; end != ends_.end() && end->cell <= last; ++end) {
        const double share = (end->position - x).squaredNorm() / (radius_ * radius_);
        if (share < 1.0 && end->normal.dot(normal) > least_cosine)
          sum += end->strength * (1.0 - share);
      }
    }
  return sum * 2.0 / (std::numbers::pi * radius_ * radius_);
}

Eigen::VectorXd EndLayer::density(const Points& x, const Points& normals,
                                  const Workers& workers) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(x.cols());
  if (ends_.empty()) return result;
  workers.for_chunks(static_cast<std::size_t>(x.cols()), points_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (auto i = static_cast<Eigen::Index>(begin);
                            i < static_cast<Eigen::Index>(end); ++i)
                         result[i] = density_at(x.col(i), normals.col(i));
                     });
  return result;
}

}  // namespace knotlight
