#include "bkm/photon_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "bkm/charge_cluster.h"
#include "bkm/charge_lanes.h"
#include "bkm/charge_tree.h"
#include "bkm/robin_image.h"

namespace knotlight {
namespace {

constexpr double inverse_4pi = 0.25 / std::numbers::pi;

// What float makes of a sum of terms that do not cancel, as a share of it; measured 1e-6.
constexpr double rounding_share = 3e-6;
constexpr double least_tolerance = 1e-5;  // above what rounding does

constexpr std::size_t batches_per_chunk = 8;  // about a millisecond of work

// Nodes beyond this ratio of radius to distance are opened without asking for their bounds: no
// degree would do, and bounds cost an exponential function each.
constexpr double hopeless_ratio = 0.75;

// Leaves with so few charges cost less than their expansion.
constexpr std::uint32_t few_charges = 6;

// Up to sixteen points near each other: what shares the decisions which clusters to open.
struct PointBatch {
  std::array<std::size_t, lane_count> index;  // the last point is repeated if there are fewer
  std::size_t count = 0;
};

// Points divided at medians until they fit a batch; all batches but one are full.
void make_batches(const Points& x, std::size_t* begin, std::size_t* end,
                  std::vector<PointBatch>& batches) {
  const auto count = static_cast<std::size_t>(end - begin);
  if (count <= lane_count) {
    PointBatch batch;
    batch.count = count;
    for (std::size_t i = 0; i < lane_count; ++i) batch.index[i] = begin[std::min(i, count - 1)];
    batches.push_back(batch);
    return;
  }
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 hi = -lo;
  for (const std::size_t* i = begin; i != end; ++i) {
    lo = lo.cwiseMin(x.col(static_cast<Eigen::Index>(*i)));
    hi = hi.cwiseMax(x.col(static_cast<Eigen::Index>(*i)));
  }
  Eigen::Index axis = 0;
  (hi - lo).maxCoeff(&axis);
  const std::size_t full = (count + lane_count - 1) / lane_count;
  std::size_t* middle = begin + (full / 2) * lane_count;
  std::nth_element(begin, middle, end, [&](std::size_t a, std::size_t b) {
    const double xa = x(axis, static_cast<Eigen::Index>(a));
    const double xb = x(axis, static_cast<Eigen::Index>(b));
    return xa < xb || (xa == xb && a < b);
  });
  make_batches(x, begin, middle, batches);
  make_batches(x, middle, end, batches);
}

// Where less than this share of the light arrives, nobody looks for relative accuracy.
constexpr double darkest = 1e-4;

void raise(double& largest, double x) {
  largest = std::max(largest, x);
}

double green(double r, double lambda) {
  return inverse_4pi * std::exp(-lambda * r) / r;
}

// sum |q| G / sum |q| near the charges, roughly: they fill a surface of size L, and what is further
// away than 1/lambda does not count.
double typical_green(const ChargeTree& tree) {
  const ChargeNode& root = tree.nodes[0];
  const double L = std::sqrt(root.mean_square);
  return L > 0.0 ? std::min(L, 1.0 / tree.lambda) / (8.0 * L * L) : 0.0;
}

// What expansions leave out. Clusters that are dropped are missing with their full weight; what is
// missing of the others has either sign.
struct TruncationError {
  double bound = 0.0;
  double dropped = 0.0;
  double squares = 0.0;

  void add(double cluster_bound, bool is_dropped) {
    bound += cluster_bound;
    if (is_dropped)
      dropped += cluster_bound;
    else
      squares += cluster_bound * cluster_bound;
  }
  double estimate() const { return dropped + std::sqrt(squares); }
};

using DoubleLanes [[gnu::vector_size(lane_count * sizeof(double))]] = double;

}  // namespace

struct PhotonSum::Tree {
  ChargeTree charges;
  PhotonSumOptions options;
  double k;          // in units of the tree
  double softening;  // in units of the tree
  BallField ball;
};

namespace {

// One batch against the whole tree; everything in units of the tree.
class BatchSum {
 public:
  BatchSum(const ChargeTree& tree, double tolerance, double k, double softening,
           const BallField& ball, bool derivatives)
      : tree_(tree),
        half_tolerance_(0.5 * tolerance),
        k_(k),
        softening_(softening),
        ball_(ball),
        derivatives_(derivatives) {}

  // Results per lane, without the factor 1/(4 pi).
  DoubleLanes value, derivative, magnitude, slope_magnitude;
  TruncationError error, derivative_error;  // for every point of the batch
  std::uint64_t direct = 0, clusters = 0;   // interactions per point

  // x, n: the batch's points and normals (n is not read without derivatives).
  void run(const std::array<Vec3, lane_count>& x, const std::array<Vec3, lane_count>& n) {
    value = derivative = magnitude = slope_magnitude = DoubleLanes{};
    error = derivative_error = {};
    direct = clusters = 0;
    place(x, n);
    mean_green_ =
        std::max(least_magnitude() / tree_.nodes[0].strength, darkest * typical_green(tree_));
    stack_.assign(1, 0);
    while (!stack_.empty()) {
      const std::uint32_t index = stack_.back();
      stack_.pop_back();
      visit(index);
    }
  }

 private:
  void place(const std::array<Vec3, lane_count>& x, const std::array<Vec3, lane_count>& n) {
    Vec3 lo = x[0];
    Vec3 hi = x[0];
    for (std::size_t i = 0; i < lane_count; ++i) {
      lo = lo.cwiseMin(x[i]);
      hi = hi.cwiseMax(x[i]);
      x_[i] = x[i].x();
      y_[i] = x[i].y();
      z_[i] = x[i].z();
      points_.nx[i] = static_cast<float>(n[i].x());
      points_.ny[i] = static_cast<float>(n[i].y());
      points_.nz[i] = static_cast<float>(n[i].z());
    }
    center_ = 0.5 * (lo + hi);
    radius_ = 0.0;
    for (const Vec3& p : x) radius_ = std::max(radius_, (p - center_).norm());
  }

  // A lower bound of sum |q| G, the same for all points of the batch: each cluster as far away as
  // its farthest charge from the farthest point.
  double least_magnitude() {
    double sum = 0.0;
    stack_.assign(1, 0);
    while (!stack_.empty()) {
      const ChargeNode& node = tree_.nodes[stack_.back()];
      stack_.pop_back();
      const double distance = (node.center - center_).norm();
      constexpr double opening = 0.5;
      if (node.leaf() || node.radius < opening * distance || node.radius < radius_)
        sum += node.strength * green(distance + radius_ + node.radius, tree_.lambda);
      else
        push_children(node);
    }
    return sum;
  }

  void push_children(const ChargeNode& node) {
    for (std::uint32_t i = node.child_count; i-- > 0;) stack_.push_back(node.first_child + i);
  }

  void visit(std::uint32_t index) {
    const ChargeNode& node = tree_.nodes[index];
    if (!(node.leaf() && node.charge_count <= few_charges)) {
      if (expand(index, node)) return;
      if (!node.leaf()) {
        push_children(node);
        return;
      }
    }
    move_to(node, 1.0);
    LaneSums sums{};
    add_charges(points_, &tree_.charges[node.first_charge], node.charge_count,
                static_cast<float>(tree_.lambda), ball_, derivatives_, sums);
    add(sums, 1.0);
    direct += node.charge_count;
  }

  // The whole node by its expansion, or not at all where that is within the tolerance; false if
  // neither is.
  bool expand(std::uint32_t index, const ChargeNode& node) {
    const double distance = (node.center - center_).norm();
    const double nearest = distance - radius_;  // of the points from the node's centre
    if (nearest <= node.radius + softening_ || node.radius > hopeless_ratio * nearest) return false;
    const TruncationBounds bounds =
        truncation_bounds(nearest, node.radius, node.mean_square, tree_.lambda, node.grown);
    // The tolerance in two halves: one as a share of what this cluster gives, one as its share, by
    // strength, of what all give.
    const double farthest = distance + radius_ + node.radius;
    const double least = green(farthest, tree_.lambda);
    const double allowed = half_tolerance_ * std::max(least, mean_green_);
    const double slope_allowed =
        half_tolerance_ *
        std::max(least * (1.0 / k_ + tree_.lambda + 1.0 / farthest), mean_green_ / k_);
    for (int cut = 0; cut < cluster_degree + 2; ++cut) {
      const auto at = static_cast<std::size_t>(cut);
      if (!(bounds.value[at] <= allowed)) continue;
      if (derivatives_ && !(bounds.derivative[at] <= slope_allowed)) continue;
      error.add(node.strength * bounds.value[at], cut == 0);
      derivative_error.add(node.strength * bounds.derivative[at], cut == 0);
      if (cut > 0) add_expansion(index, node, cut - 1, nearest);
      return true;
    }
    return false;
  }

  void add_expansion(std::uint32_t index, const ChargeNode& node, int degree, double nearest) {
    const double scale = node.scale();
    move_to(node, 1.0 / scale);
    LaneSums sums{};
    add_cluster(points_, tree_.coefficients_of(index), degree,
                static_cast<float>(tree_.lambda * scale), derivatives_, sums);
    const double most = std::exp(-tree_.lambda * nearest) / nearest;
    sums.magnitude = static_cast<float>(node.strength * most) - Lanes{};
    sums.slope_magnitude =
        static_cast<float>(scale * node.strength * most * (tree_.lambda + 1.0 / nearest)) - Lanes{};
    add(sums, 1.0 / scale);
    ++clusters;
  }

  // Points relative to the node's centre, in units of 1 / `factor`.
  void move_to(const ChargeNode& node, double factor) {
    points_.x = __builtin_convertvector((x_ - node.center.x()) * factor, Lanes);
    points_.y = __builtin_convertvector((y_ - node.center.y()) * factor, Lanes);
    points_.z = __builtin_convertvector((z_ - node.center.z()) * factor, Lanes);
  }

  void add(const LaneSums& sums, double slope_factor) {
    value += __builtin_convertvector(sums.value, DoubleLanes);
    derivative += slope_factor * __builtin_convertvector(sums.derivative, DoubleLanes);
    magnitude += __builtin_convertvector(sums.magnitude, DoubleLanes);
    slope_magnitude += slope_factor * __builtin_convertvector(sums.slope_magnitude, DoubleLanes);
  }

  const ChargeTree& tree_;
  double half_tolerance_, k_, softening_;
  const BallField& ball_;
  bool derivatives_;

  DoubleLanes x_, y_, z_;
  LanePoints points_{};
  Vec3 center_;
  double radius_ = 0.0;
  double mean_green_ = 0.0;  // a lower bound of sum |q| G / sum |q|
  std::vector<std::uint32_t> stack_;
};

void check(const PointSources& sources, double lambda, double k, const PhotonSumOptions& options) {
  const Eigen::Index n = sources.size();
  if (sources.strengths.size() != n || sources.plane_points.cols() != n ||
      sources.plane_normals.cols() != n || sources.clear_heights.size() != n)
    throw std::invalid_argument("PhotonSum: sizes of the sources do not match");
  if (!(lambda >= 0.0) || !(k > 0.0) || !std::isfinite(lambda) || !std::isfinite(k))
    throw std::invalid_argument("PhotonSum: lambda must be >= 0 and k > 0");
  if (!(options.tolerance >= least_tolerance))
    throw std::invalid_argument("PhotonSum: tolerance must be at least 1e-5");
  if (!(options.softening >= 0.0) || !(lambda * options.softening <= 1.0))
    throw std::invalid_argument("PhotonSum: lambda * softening must be between 0 and 1");
}

}  // namespace

PhotonSum::PhotonSum(PointSources sources, double lambda, double k, const PhotonSumOptions& options,
                     const Workers& workers) {
  check(sources, lambda, k, options);
  ChargeSource source;
  source.groups = static_cast<std::size_t>(sources.size());
  source.charges = [&](std::size_t group, PointCharge* out) {
    const auto s = static_cast<Eigen::Index>(group);
    const double strength = sources.strengths[s];
    out[0] = {sources.positions.col(s), strength};
    if (sources.clear_heights[s] < 0.0) return 1;
    const RobinImage image =
        robin_image(sources.positions.col(s), strength, sources.plane_points.col(s),
                    sources.plane_normals.col(s), k, lambda, sources.clear_heights[s]);
    std::copy(image.begin(), image.end(), out + 1);
    return 1 + image.count;
  };
  auto tree = std::make_unique<Tree>();
  tree->charges = make_charge_tree(source, lambda, workers);
  tree->options = options;
  tree->k = k / tree->charges.unit;
  tree->softening = options.softening / tree->charges.unit;
  if (options.softening > 0.0) tree->ball = ball_field(tree->softening, tree->charges.lambda);
  tree_ = std::move(tree);
}

PhotonSum::~PhotonSum() = default;
PhotonSum::PhotonSum(PhotonSum&&) noexcept = default;
PhotonSum& PhotonSum::operator=(PhotonSum&&) noexcept = default;

std::size_t PhotonSum::charges() const {
  return tree_->charges.charges.size();
}

PhotonSumValues PhotonSum::evaluate(const Points& x, const Points* normals,
                                    const Workers& workers) const {
  const ChargeTree& tree = tree_->charges;
  const auto n = static_cast<std::size_t>(x.cols());
  PhotonSumValues result;
  if (tree.nodes.empty() || n == 0) {
    result.value.setZero(x.cols());
    if (normals != nullptr) result.normal_derivative.setZero(x.cols());
    return result;
  }
  result.value.resize(x.cols());
  if (normals != nullptr) result.normal_derivative.resize(x.cols());
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<PointBatch> batches;
  make_batches(x, order.data(), order.data() + n, batches);

  const double to_value = tree.strength_unit / tree.unit;
  const double to_derivative = to_value / tree.unit;
  std::vector<PhotonSumValues> parts((batches.size() + batches_per_chunk - 1) / batches_per_chunk);
  workers.for_chunks(
      batches.size(), batches_per_chunk,
      [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        BatchSum sum(tree, tree_->options.tolerance, tree_->k, tree_->softening, tree_->ball,
                     normals != nullptr);
        PhotonSumValues& part = parts[chunk];
        for (std::size_t b = begin; b < end; ++b) {
          const PointBatch& batch = batches[b];
          std::array<Vec3, lane_count> at;
          std::array<Vec3, lane_count> normal;
          for (std::size_t i = 0; i < lane_count; ++i) {
            const auto p = static_cast<Eigen::Index>(batch.index[i]);
            at[i] = (x.col(p) - tree.origin) / tree.unit;
            normal[i] = normals != nullptr ? Vec3(normals->col(p)) : Vec3(Vec3::Zero());
          }
          sum.run(at, normal);
          for (std::size_t i = 0; i < batch.count; ++i) {
            const auto p = static_cast<Eigen::Index>(batch.index[i]);
            result.value[p] = to_value * inverse_4pi * sum.value[i];
            const double rounding = inverse_4pi * rounding_share * sum.magnitude[i];
            raise(part.error_bound, to_value * (sum.error.bound + rounding));
            raise(part.error_estimate, to_value * (sum.error.estimate() + rounding));
            if (normals == nullptr) continue;
            result.normal_derivative[p] = to_derivative * inverse_4pi * sum.derivative[i];
            const double slope_rounding = inverse_4pi * rounding_share * sum.slope_magnitude[i];
            raise(part.derivative_error_bound,
                  to_derivative * (sum.derivative_error.bound + slope_rounding));
            raise(part.derivative_error_estimate,
                  to_derivative * (sum.derivative_error.estimate() + slope_rounding));
          }
          part.direct_interactions += batch.count * sum.direct;
          part.cluster_interactions += batch.count * sum.clusters;
        }
      });
  for (const PhotonSumValues& part : parts) {
    raise(result.error_bound, part.error_bound);
    raise(result.error_estimate, part.error_estimate);
    raise(result.derivative_error_bound, part.derivative_error_bound);
    raise(result.derivative_error_estimate, part.derivative_error_estimate);
    result.direct_interactions += part.direct_interactions;
    result.cluster_interactions += part.cluster_interactions;
  }
  return result;
}

}  // namespace knotlight
