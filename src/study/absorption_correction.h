// Diffusion where absorption varies from place to place, by a solver that knows one absorption:
//
//   lap U - sigma0 U = -S + (sigma(x) - sigma0) U      inside,    U + k dU/dn = 0 on the surface,
//
// sigma = 3 sigma_a sigma_tr, with one sigma_tr everywhere. The last term is a source too, negative
// where more is absorbed than sigma0 says; it needs U, and so is iterated. With F the field of a
// source in the body of one absorption sigma0,
//
//   (1 + F (sigma - sigma0)) U = F S                                                          (*)
//
// at the cells where sigma differs from sigma0, by Richardson's iteration (the Born series) or
// GMRES; after that U is known everywhere. It is what [ABW11] solves by finite elements.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "bkm/global_solver.h"
#include "bkm/photon_sum.h"
#include "study/volume_cells.h"

namespace knotlight {

// The field of charges in the body of one absorption.
class ChargeField {
 public:
  ChargeField(PhotonSum particular, GlobalField homogeneous, Workers workers);
  Eigen::VectorXd values(const Points& x) const;

 private:
  PhotonSum particular_;
  GlobalField homogeneous_;
  Workers workers_;
};

// F: the photon sum for the charges, exterior sources for what it leaves of the boundary condition,
// factored once. For convex bodies: every charge has its Robin image.
class ChargeSolver {
 public:
  // sigma0 = lambda^2 > 0, 1/length^2; k: length; knots: where the Robin condition is asked for;
  // outside: the sources, fewer than knots.
  ChargeSolver(double sigma0, double k, const SurfaceSamples& knots, const Points& outside,
               const Workers& workers);

  // density: source per volume, one per cell, each spread over a ball as large as the mean cell.
  ChargeField field(const VolumeCells& cells, const Eigen::VectorXd& density) const;
  double sigma0() const { return sigma0_; }

 private:
  double sigma0_;
  GlobalBkmSolver boundary_;
  Workers workers_;
};

enum class CorrectionMethod { born_series, gmres };

struct AbsorptionProblem {
  const ChargeSolver& solver;
  const ChargeField& lit;        // F S
  const VolumeCells& cells;      // where sigma differs from that of the solver
  const Eigen::VectorXd& sigma;  // there, 1/length^2
};

struct CorrectedField {
  Eigen::VectorXd U;              // at the cells
  std::vector<double> residuals;  // of (*), over its right side, rms; the first is that of U = 0
  bool converged = false;
  std::shared_ptr<const ChargeField> absorbed;  // add `lit` for U
};

// Until the residual is below `tolerance`, at most `most` times; the Born series is given up when
// it has grown a hundredfold.
CorrectedField correct_absorption(const AbsorptionProblem& problem, CorrectionMethod method,
                                  double tolerance, int most);

}  // namespace knotlight
