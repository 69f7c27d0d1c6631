#include "bkm/assembly.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bkm/kernel_batch.h"

namespace knotlight {
namespace {

// [V09 ch. 6.3]: entries this small only slow the decomposition down.
constexpr double tiny = 1e-30;

}  // namespace

Eigen::MatrixXd source_matrix(const Points& points, double c, double lambda) {
  const Eigen::Index count = points.cols();
  const PointColumns rows = point_columns(points);
  Eigen::MatrixXd phi(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index first = 0; first < count; first += batch_size) {
      const Eigen::Index n = std::min(batch_size, count - first);
      const Batch s = squared_distances(rows, first, n, points.col(j));
      phi.col(j).segment(first, n) = gaussian_helmholtz_values(s, c, lambda).matrix();
    }
  return phi;
}

Eigen::MatrixXd robin_matrix(const Points& knots, const Points& normals, double lambda, double k,
                             double R) {
  assert(normals.cols() == knots.cols());
  const Eigen::Index count = knots.cols();
  const PointColumns rows = point_columns(knots);
  const PointColumns row_normals = point_columns(normals);
  Eigen::MatrixXd robin(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    for (Eigen::Index first = 0; first < count; first += batch_size) {
      const Eigen::Index n = std::min(batch_size, count - first);
      const RadialBatch w =
          nonsingular_solutions(squared_distances(rows, first, n, knots.col(j)), lambda, R);
      Batch along_normal = Batch::Zero(n);  // (x_i - x_j) . n_i [V09 6.14]
      for (int axis = 0; axis < 3; ++axis)
        along_normal += (rows.col(axis).segment(first, n) - knots(axis, j)) *
                        row_normals.col(axis).segment(first, n);
      robin.col(j).segment(first, n) = (w.value + k * w.slope * along_normal).matrix();
    }
  return robin;
}

void zero_tiny_entries(Eigen::MatrixXd& a) {
  const double limit = tiny * a.cwiseAbs().maxCoeff();
  for (double& entry : a.reshaped())
    if (std::abs(entry) < limit) entry = 0.0;
}

}  // namespace knotlight
