// The diffusion equation in an object of any shape on a grid of cubic cells: trilinear finite
// elements cut off at the surface (docs/grid.md).
//
//   lap u - lambda^2 u = f inside,   u + k du/dn = g on the boundary, n outward.
//
// f is a sum of points, -sum q_p delta(x - x_p), of dipoles and a constant; g is given at points of
// the surface. Knows a shape and numbers only.
#pragma once

#include <memory>
#include <string>

#include "grid/geometry.h"
#include "grid/multigrid.h"

namespace knotlight {

// A right-hand side, collected piece by piece. Sums to the strength of all sources.
class GridLoad {
 public:
  explicit GridLoad(const GridGeometry& geometry);

  // Point sources: positions 3 x N, inside or on the surface; strengths q, N:
  // -(lap - lambda^2) u = sum q_p delta(x - x_p). Those that are not near a cell are left out and
  // their |q| counted in lost().
  void add_sources(const Points& positions, const Eigen::VectorXd& strengths);
  // One source. Not to be called from two threads at once.
  void add_source(const Vec3& position, double strength);
  // The same on the surface, with its outward normal there.
  void add_source(const Vec3& position, const Vec3& normal, double strength);
  // A source with a direction, the divergence of a flux: load int m . grad v for the test function
  // v. Light that scatters forwards: the photon of power P and direction w is the source q = 3
  // sigma_s sigma_tr P / (4 pi sigma_t) with the moment m = 3 g sigma_s P w / (4 pi sigma_t).
  // Together they are f and the Robin data of docs/theory.md: integrating div Q_ri by parts brings
  // up a boundary term that is g / k exactly, so neither is ever estimated.
  void add_dipole(const Vec3& position, const Vec3& moment);
  // The constant part of f.
  void add_uniform(double f);
  // Boundary data by quadrature over the surface: g at points (positions and outward normals, 3 x
  // N) that stand for `areas` of it.
  void add_boundary_data(const Points& positions, const Points& normals,
                         const Eigen::VectorXd& areas, const Eigen::VectorXd& g, double k);

  const Eigen::VectorXd& values() const { return values_; }
  double total() const { return values_.sum(); }
  double lost() const { return lost_; }

 private:
  void add(const Place& place, double strength);

  const GridGeometry* geometry_;
  Eigen::VectorXd values_;
  double lost_ = 0.0;
};

// A solution. Keeps the geometry alive.
class GridField {
 public:
  GridField() = default;  // not a number everywhere
  GridField(std::shared_ptr<const GridGeometry> geometry, Eigen::VectorXd values)
      : geometry_(std::move(geometry)), values_(std::move(values)) {}

  // u inside or on the surface, trilinear in each cell and continuous; NaN far from the object. A
  // surface point should be given with its outward normal: see GridGeometry::locate.
  double value(const Vec3& x) const;
  // The same, 0 far from the object: nothing is there.
  double value_or_nothing(const Vec3& x) const;
  double value(const Vec3& x, const Vec3& normal) const;
  Eigen::VectorXd values(const Points& x) const;
  Eigen::VectorXd values(const Points& x, const Points& normals) const;
  // With its gradient (constant along each axis within a cell), in 1/length times the unit of u.
  struct Sample {
    double value;
    Vec3 gradient;
  };
  Sample sample(const Vec3& x) const;
  // Values at the nodes.
  const Eigen::VectorXd& nodes() const { return values_; }
  const GridGeometry& geometry() const { return *geometry_; }

 private:
  double at(const Place& place) const;

  std::shared_ptr<const GridGeometry> geometry_;
  Eigen::VectorXd values_;
};

struct GridSolution {
  GridField field;
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;         // relative, of the linear system
  double volume_integral = 0.0;  // of u, length^3 times its unit
  double surface_integral = 0.0;
  // (lambda^2 volume_integral + surface_integral / k - load) / load: zero up to the residual. With
  // g = 0 it says: absorbed + leaving = sources.
  double imbalance = 0.0;
};

// Sets up once, solves for any number of right-hand sides; solve() may be called from several
// threads.
class GridSolver {
 public:
  // geometry->ok(); lambda >= 0 (1/length); k > 0 (length). k far below the cell size acts as a
  // stiff penalty and loses accuracy.
  GridSolver(std::shared_ptr<const GridGeometry> geometry, double lambda, double k);
  // tolerance: of the linear system, |b - A x| <= tolerance |b|. start: values at the nodes that
  // the iteration begins with; empty = zero.
  GridSolution solve(const GridLoad& load, double tolerance = 1e-9) const;
  GridSolution solve(const Eigen::VectorXd& load, double tolerance = 1e-9,
                     const Eigen::VectorXd& start = {}) const;
  // On cells of twice the size, with the same sources; the field is that of the larger cells, told
  // at the nodes of the smaller. geometry->has_nested_coarse().
  GridSolution solve_coarse(const Eigen::VectorXd& load, double tolerance = 1e-9) const;
  const GridGeometry& geometry() const { return *geometry_; }

 private:
  GridSolution solution(const Eigen::VectorXd& load, ConjugateGradientResult result) const;

  std::shared_ptr<const GridGeometry> geometry_;
  double lambda_, k_;
  NodeWeights weights_;
  Multigrid multigrid_;
};

}  // namespace knotlight
