// Where along a ray in a medium its light interacts first: quadrature points of the depth law
// exp(-t), t = optical depth, between 0 and the optical length tau of the ray.
#pragma once

#include <vector>

namespace knotlight {

struct DepthPoint {
  double optical_depth;
  double weight;  // expected share of the light; they add up to 1 - exp(-tau)
};

// m points, one in each m-th part of the light that interacts, at the same place `offset` (in
// [0, 1)) of each part and of equal weight. Unbiased over uniform offsets for any function of
// depth; m = 1 is sampling the depth law itself.
void stratified_depths(double tau, int m, double offset, std::vector<DepthPoint>& out);

// The m-point Gauss rule of the depth law cut off at tau: exact for polynomials of depth up to
// degree 2m - 1 (relative 1e-9), m <= 8. Gauss-Laguerre for an endless ray.
void gauss_depths(double tau, int m, std::vector<DepthPoint>& out);

}  // namespace knotlight
