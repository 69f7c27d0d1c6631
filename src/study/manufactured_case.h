// The thesis's problem with a known solution [V09 7.1-7.3]: u = x^2 sin x cos y cos z in [0, 2]^3,
// lambda^2 = 3, k = 1. The thesis does not say which cube; this is the one of its fig. 7.3.
#pragma once

#include "bkm/thesis_solver.h"
#include "core/shape.h"

namespace knotlight {

constexpr double manufactured_k = 1.0;           // length
double manufactured_lambda();                    // sqrt(3) per length
constexpr double manufactured_largest = 3.6372;  // of |u|: 4 sin 2 at x = 2, y = z = 0, rounded

double manufactured_u(const Vec3& x);
Vec3 manufactured_gradient(const Vec3& x);
double manufactured_source(const Vec3& x);  // lap u - lambda^2 u

// n x n knots on each face, m^3 of a lattice inside.
struct ManufacturedProblem {
  BkmThesisProblem problem;
  Eigen::VectorXd f, g;
};
ManufacturedProblem manufactured_problem(int n, int m);
// u + k du/dn at points of the faces.
Eigen::VectorXd manufactured_data(const SurfaceSamples& at);

// As it should be: Gaussians as wide as the cube, damped by cross-validation, and sources on a cube
// three times as large in place of the non-singular solutions, by least squares over more points
// than there are of them: well conditioned. Values at the check points below. Single precision
// rounds coordinates and distances to float everywhere.
Eigen::VectorXd manufactured_better(const ManufacturedProblem& p, int n,
                                    DistancePrecision precision);

// 400 random points, half of them on the faces; none is a knot.
Points manufactured_checks();
// Largest |values - u| over them.
double manufactured_error(const Eigen::VectorXd& values);

}  // namespace knotlight
