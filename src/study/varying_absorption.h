// Diffusion with absorption that varies from place to place, without charges: what the study of
// heterogeneous materials measures against. lap U - sigma(x) U = -S, U + k dU/dn = 0.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/vec3.h"

namespace knotlight {

// The ball |x| < 1 with coefficients of the radius; div(spread grad U) stands in place of lap U,
// with spread 1 at the surface.
struct RadialProblem {
  double k = 1.0;  // length
  std::function<double(double)> sigma, source;
  std::function<double(double)> spread = [](double) { return 1.0; };
};
// U at (0, 1, .. n) / n by finite volumes, second order in 1/n where jumps lie at multiples of it.
Eigen::VectorXd radial_differences(int n, const RadialProblem& problem);

// The cube [0, side]^3 cut into n^3 cells. sigma and S are asked for at cell centres and hold all
// over their cells, but for a factor exp(-steep z) of S that is integrated exactly.
struct CubeProblem {
  double side = 1.0;   // length
  double k = 1.0;      // length
  double steep = 0.0;  // 1/length
  std::function<double(const Vec3&)> sigma, source;
};

struct CubeSolution {
  int n = 0;
  Eigen::VectorXd U;  // at the (n + 1)^3 corners of cells, z fastest, then y
  int iterations = 0;
  bool converged = false;

  double at(int i, int j, int l) const { return U[(Eigen::Index{i} * (n + 1) + j) * (n + 1) + l]; }
};

// Finite volumes about the corners of cells, halved at faces and so on: the usual seven points
// inside, second order up to the surface. By conjugate gradients to a residual of `tolerance`.
CubeSolution cube_differences(int n, const CubeProblem& problem, double tolerance);

}  // namespace knotlight
