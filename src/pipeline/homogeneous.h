// What the boundary methods have in common once the homogeneous part is found: the certificate at
// points that are not knots, noise apart from solver error, and the field handed on.
#pragma once

#include <algorithm>
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

// What every boundary method starts from.
struct BoundaryStart {
  std::shared_ptr<const ParticularSolution> particular;
  BoundaryChecks checks;
};
BoundaryStart boundary_start(const ChannelProblem& problem);

// What may be left of the boundary condition, as BoundaryVerdict::robin_residual: half of the
// tolerance, noise takes the other half.
double residual_wanted(const ChannelProblem& problem);

// Systems factored for an earlier light, and what they left of it.
template <class Factors>
struct KeptFactors {
  // More than this times what is wanted, or what they left before, asks for new ones.
  static constexpr double as_good_as_before = 1.2;

  std::shared_ptr<const Factors> factors;
  double residual;

  bool serve(double residual_now, double wanted) const {
    return residual_now <= as_good_as_before * std::max(residual, wanted);
  }
};

struct BoundaryVerdict {
  double scale = 0.0;             // rms of U_d over the surface
  double noise = 0.0;             // of U_d there, rms, by the two halves, over scale
  double robin_residual = 0.0;    // rms of what both halves leave in common, over scale
  double solver_error = 0.0;      // rms that it leaves in U_d (residual_effect.h), over scale
  double largest_residual = 0.0;  // of the mean of both, noise included, over scale
};
BoundaryVerdict judge_boundary(const ChannelProblem& problem, const BoundaryChecks& checks,
                               const std::array<HomogeneousPart, 2>& halves);

// The solution of a boundary method: U_d = mean of the particular halves + u_h, with its errors.
ChannelSolution boundary_solution(const ChannelProblem& problem,
                                  std::shared_ptr<const ParticularSolution> particular,
                                  const BoundaryVerdict& verdict, HomogeneousPart mean);

}  // namespace knotlight
