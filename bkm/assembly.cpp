#include "bkm/assembly.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bkm/kernel_batch.h"

namespace knotlight {
namespace {

// [V09 ch. 6.3]: entries this small only slow the decomposition down.
constexpr double tiny = 1e-30;
// Columns a worker takes at once: enough to be worth a thread's while with short columns.
constexpr std::size_t columns_at_once = 16;

// Calls body(column, first row, rows) for pieces of every column.
template <typename Body>
void for_pieces(Eigen::Index rows, Eigen::Index columns, const Workers& workers, const Body& body) {
  workers.for_chunks(static_cast<std::size_t>(columns), columns_at_once,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (auto j = static_cast<Eigen::Index>(begin);
                            j < static_cast<Eigen::Index>(end); ++j)
                         for (Eigen::Index first = 0; first < rows; first += batch_size)
                           body(j, first, std::min(batch_size, rows - first));
                     });
}

}  // namespace

Eigen::MatrixXd source_matrix(const Points& rows, const Points& columns, const RadialFunction& w,
                              const AssemblyOptions& options) {
  const PointColumns at = point_columns(rows);
  Eigen::MatrixXd phi(rows.cols(), columns.cols());
  for_pieces(phi.rows(), phi.cols(), options.workers,
             [&](Eigen::Index j, Eigen::Index first, Eigen::Index n) {
               const Batch s = squared_distances(at, first, n, columns.col(j), options.precision);
               phi.col(j).segment(first, n) = phi_values(w, s).matrix();
             });
  return phi;
}

// Vector instructions need not give the same bits as the scalar ones at a piece's end: one triangle
// is computed and the other copied.
Eigen::MatrixXd source_matrix(const Points& points, const RadialFunction& w,
                              const AssemblyOptions& options) {
  const PointColumns at = point_columns(points);
  Eigen::MatrixXd phi(points.cols(), points.cols());
  for_pieces(phi.rows(), phi.cols(), options.workers,
             [&](Eigen::Index j, Eigen::Index first, Eigen::Index n) {
               if (first + n <= j) return;  // above the diagonal
               const Batch s = squared_distances(at, first, n, points.col(j), options.precision);
               phi.col(j).segment(first, n) = phi_values(w, s).matrix();
             });
  phi.triangularView<Eigen::StrictlyUpper>() = phi.transpose();
  return phi;
}

Eigen::MatrixXd robin_matrix(const Points& rows, const Points& normals, const Points& columns,
                             double k, const RadialFunction& w, const AssemblyOptions& options) {
  assert(normals.cols() == rows.cols());
  const PointColumns at = point_columns(rows);
  const PointColumns row_normals = point_columns(normals);
  Eigen::MatrixXd robin(rows.cols(), columns.cols());
  for_pieces(robin.rows(), robin.cols(), options.workers,
             [&](Eigen::Index j, Eigen::Index first, Eigen::Index n) {
               const RadialBatch psi = psi_with_slopes(
                   w, squared_distances(at, first, n, columns.col(j), options.precision));
               Batch along_normal = Batch::Zero(n);  // (x_i - x_j) . n_i [V09 6.14]
               for (int axis = 0; axis < 3; ++axis)
                 along_normal += (at.col(axis).segment(first, n) - columns(axis, j)) *
                                 row_normals.col(axis).segment(first, n);
               robin.col(j).segment(first, n) = (psi.value + k * psi.slope * along_normal).matrix();
             });
  return robin;
}

void zero_tiny_entries(Eigen::MatrixXd& a) {
  const double limit = tiny * a.cwiseAbs().maxCoeff();
  for (double& entry : a.reshaped())
    if (std::abs(entry) < limit) entry = 0.0;
}

}  // namespace knotlight
