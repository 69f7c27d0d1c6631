// The particular solution without a matrix: the field of millions of charges and their images, and
// its normal derivative, at points anywhere in or on the body, by a tree code.
//
// A cluster of charges seen from far enough is replaced by its Taylor expansion about its centre.
// What that leaves out is bounded rigorously for each pair of cluster and points (charge_cluster.h)
// by the absolute strengths, so that charges of mixed sign are safe; clusters for which the bound
// is too large are opened.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "bkm/point_sources.h"
#include "core/parallel.h"
#include "core/vec3.h"

namespace knotlight {

struct PhotonSumOptions {
  // Bound of the error at each point, as a share of what the charges and image charges would give
  // there if none cancelled another: sum |q| G for values, sum |q| (1/k + |G'|/G) G for normal
  // derivatives. In the dark, where that is less than 1e-4 of what it is near the charges, a share
  // of those 1e-4. True errors are some 500 times smaller. At least 1e-5: the sums are in float.
  double tolerance = 1e-2;
  // Each charge fills a ball of this radius, length; 0: points. The strength is scaled so that the
  // field outside the ball is that of the point; lambda * softening <= 1. Near the surface that
  // trades noise for bias: under a beam on a sphere of 20 mean free paths, a tenth of one halves
  // the noise of values there and shifts them by -0.2 % (albedo 0.99) to -0.5 % (0.9), in
  // proportion to the square of the radius.
  double softening = 0.0;
};

struct PhotonSumValues {
  Eigen::VectorXd value;              // one per point
  Eigen::VectorXd normal_derivative;  // one per point; empty without normals
  // The largest over the points: a bound that holds for any charges, and what is to be expected if
  // clusters do not conspire (their bounds added as squares; still some 20 times too much).
  double error_bound = 0.0;
  double error_estimate = 0.0;
  double derivative_error_bound = 0.0;
  double derivative_error_estimate = 0.0;
  std::uint64_t direct_interactions = 0;   // of a point with a charge
  std::uint64_t cluster_interactions = 0;  // of a point with a cluster
};

class PhotonSum {
 public:
  // lambda >= 0, 1/length; k > 0, length, of the Robin images. Throws std::invalid_argument for
  // sizes that do not match and options out of range.
  PhotonSum(PointSources sources, double lambda, double k, const PhotonSumOptions& options,
            const Workers& workers);
  ~PhotonSum();
  PhotonSum(PhotonSum&&) noexcept;
  PhotonSum& operator=(PhotonSum&&) noexcept;

  // x: 3 x N points; normals: 3 x N unit vectors or null. Same bits for any number of workers. At a
  // point charge without softening the value is not finite.
  PhotonSumValues evaluate(const Points& x, const Points* normals, const Workers& workers) const;

  std::size_t charges() const;  // with images

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace knotlight
