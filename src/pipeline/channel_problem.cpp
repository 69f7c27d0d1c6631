#include "pipeline/channel_problem.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

constexpr std::size_t boundary_checks = 512;

}  // namespace

SurfaceSamples boundary_check_points(const ChannelProblem& p) {
  return columns(
      stratified_surface_points(p.shape, boundary_checks, true, p.seed, Stream::check_points));
}

double root_mean_square(const Eigen::VectorXd& v) {
  return std::sqrt(v.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, v.size())));
}

}  // namespace knotlight
