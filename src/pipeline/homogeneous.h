// What the boundary methods have in common once the homogeneous part is found: the certificate at
// points that are not knots, noise apart from solver error, and the field handed on.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "pipeline/boundary_knots.h"
#include "pipeline/channel_problem.h"

namespace knotlight {

// A homogeneous part u_h, W/(length^2 sr), in or on the object. Safe to call from several threads.
struct HomogeneousPart {
  std::function<double(const Vec3& x)> value;
  // u_h + k du_h/dn.
  std::function<double(const Vec3& x, const Vec3& n)> robin;
};

// Surface points that are not knots, with what the particular solution is and leaves there.
struct BoundaryChecks {
  SurfaceSamples at;
  ParticularValues particular;
  BoundaryData data;
};
BoundaryChecks boundary_checks(const ChannelProblem& problem, const ParticularSolution& particular);

struct BoundaryVerdict {
  double scale = 0.0;             // rms of U_d over the surface
  double noise = 0.0;             // of U_d there, rms, by the two halves, over scale
  double robin_residual = 0.0;    // rms of what both halves leave in common, over scale
  double solver_error = 0.0;      // rms that it leaves in U_d (residual_effect.h), over scale
  double largest_residual = 0.0;  // of the mean of both, noise included, over scale
};
BoundaryVerdict judge_boundary(const ChannelProblem& problem, const BoundaryChecks& checks,
                               const std::array<HomogeneousPart, 2>& halves);

// Tree code and smoothing for a solution of the tolerance that the scene asks for.
PhotonSumOptions particular_options(const ChannelProblem& problem);

// The solution of a boundary method: U_d = mean of the particular halves + u_h, with its errors.
ChannelSolution boundary_solution(const ChannelProblem& problem,
                                  std::shared_ptr<const ParticularSolution> particular,
                                  const BoundaryVerdict& verdict, HomogeneousPart mean);

}  // namespace knotlight
