// The part of the solution that takes care of the sources and ignores the boundary, in closed form:
// every photon with its images, and what the object itself emits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "bkm/photon_sum.h"
#include "pipeline/channel_problem.h"
#include "pipeline/end_layer.h"

namespace knotlight {

// At N points, for each half of the light, W/(length^2 sr).
struct ParticularValues {
  std::array<Eigen::VectorXd, 2> value;
  std::array<Eigen::VectorXd, 2> normal_derivative;  // per length; empty without normals
  // Right-hand side of the Robin condition that belongs to sources on the surface (flights' ends, g
  // != 0), W/(length^2 sr); empty without normals.
  std::array<Eigen::VectorXd, 2> surface_data;
};

class ParticularSolution {
 public:
  ParticularSolution(const ChannelProblem& problem, const PhotonSumOptions& options);

  // x: 3 x N points in or on the object; normals: 3 x N or null.
  ParticularValues evaluate(const Points& x, const Points* normals, const Workers& workers) const;
  std::size_t charges() const;  // of both halves, with images

 private:
  double lambda_;
  double emitted_;  // f of the object's own emission, W/(length^4 sr), 0 or negative
  Vec3 center_;     // and radius of a ball that holds the object
  double radius_;
  double k_;
  std::array<std::unique_ptr<const PhotonSum>, 2> sums_;
  std::array<std::unique_ptr<const EndLayer>, 2> layers_;
};

}  // namespace knotlight
