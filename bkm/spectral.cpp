#include "bkm/spectral.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "bkm/lapack.h"
#include "core/rng.h"

namespace knotlight {
namespace {

// Smaller matrices are decomposed at once: there is nothing to gain.
constexpr Eigen::Index least_size_to_compress = 512;
// Columns added to the range at once: enough for products to run at full speed, few enough to stop
// near the rank.
constexpr Eigen::Index block_columns = 64;
// Beyond this part of the size a full decomposition is as cheap.
constexpr double largest_part = 0.5;
// What is left out must lie this far below the cut: a random column sees the root of the sum of the
// squares of all that is left out, so the largest of 64 of them does not miss a value of this size.
constexpr double well_below = 0.1;
// Below this part of the largest singular value, times sqrt(n), all is rounding of the matrix and
// the search would never end.
constexpr double rounding = 2.0 * std::numeric_limits<double>::epsilon();
constexpr std::uint64_t any_seed = 1;

Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index first, Eigen::Index columns) {
  Eigen::MatrixXd r(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    Rng rng(any_seed, Stream::random_projection, static_cast<std::uint64_t>(first + j));
    for (Eigen::Index i = 0; i < rows; ++i) r(i, j) = 2.0 * rng.uniform() - 1.0;
  }
  return r;
}

double longest_column(const Eigen::MatrixXd& a) {
  return std::sqrt(a.colwise().squaredNorm().maxCoeff());
}

// Orthonormal columns that hold the range of a but for `target` of its size; none if that takes
// more than `largest_part` of all columns.
Eigen::MatrixXd range_basis(const Eigen::MatrixXd& a, double target, const Workers& workers) {
  const auto most =
      static_cast<Eigen::Index>(largest_part * static_cast<double>(std::min(a.rows(), a.cols())));
  Eigen::MatrixXd basis(a.rows(), most);
  double size = 0.0;  // of what a makes of a random column
  for (Eigen::Index k = 0; k + block_columns <= most; k += block_columns) {
    Eigen::MatrixXd y =
        lapack::product(a, random_columns(a.cols(), k, block_columns), false, workers);
    if (k == 0) size = longest_column(y);
    const auto known = basis.leftCols(k);
    // Twice: the first time leaves rounding of the part taken away.
    for (int pass = 0; pass < 2; ++pass)
      y -= lapack::product(known, lapack::product(known, y, true, workers), false, workers);
    const double left = longest_column(y) / size;
    if (left <= target) return known;
    // Logarithms fall ever more slowly with k: what a straight line promises comes later or never.
    if (k > 0 &&
        static_cast<double>(k) * std::log(target) / std::log(left) > static_cast<double>(most))
      break;
    lapack::thin_qr(y);
    // Columns of rounding are orthonormal among themselves only.
    y -= lapack::product(known, lapack::product(known, y, true, workers), false, workers);
    lapack::thin_qr(y);
    basis.middleCols(k, block_columns) = y;
  }
  return Eigen::MatrixXd(a.rows(), 0);
}

bool is_symmetric(const Eigen::MatrixXd& a) {
  return a.rows() == a.cols() && a == a.transpose();
}

// q s (q v)^T from the eigenvalues of q^T a q; q = identity if it is empty. Eigenvalues are
// singular values but for their signs, which go to v.
SpectralFactors by_eigenvalues(Eigen::MatrixXd core, const Eigen::MatrixXd& q,
                               const Workers& workers) {
  SpectralFactors found;
  Eigen::VectorXd d;
  found.message = lapack::symmetric_eigen(core, d);
  if (!found.message.empty()) return found;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(d.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index i, Eigen::Index j) { return std::abs(d(i)) > std::abs(d(j)); });
  const Eigen::MatrixXd vectors = core(Eigen::all, order);
  found.u = q.size() == 0 ? vectors : lapack::product(q, vectors, false, workers);
  found.s = d(order).cwiseAbs();
  found.v = found.u;
  for (Eigen::Index j = 0; j < d.size(); ++j)
    if (d(order[static_cast<std::size_t>(j)]) < 0.0) found.v.col(j) = -found.v.col(j);
  return found;
}

// What of a lies in the range of q.
SpectralFactors in_range(const Eigen::MatrixXd& a, const Eigen::MatrixXd& q, bool symmetric,
                         const Workers& workers) {
  Eigen::MatrixXd projected = lapack::product(a, q, true, workers);  // a^T q, n x k
  if (symmetric) {
    const Eigen::MatrixXd core = lapack::product(q, projected, true, workers);
    return by_eigenvalues(0.5 * (core + core.transpose()), q, workers);
  }
  Eigen::MatrixXd r = lapack::thin_qr(projected);
  lapack::Svd core = lapack::svd(r);  // a^T = (projected u) s (q v)^T
  if (!core.message.empty()) return {{}, {}, {}, false, std::move(core.message)};
  return {lapack::product(q, Eigen::MatrixXd(core.vt.transpose()), false, workers),
          lapack::product(projected, core.u, false, workers),
          std::move(core.s),
          false,
          {}};
}

}  // namespace

double pinv_cut(Eigen::Index rows, Eigen::Index columns) {
  return static_cast<double>(std::max(rows, columns)) * std::numeric_limits<double>::epsilon();
}

SpectralFactors spectral_factors(Eigen::MatrixXd a, double relative_cut, const Workers& workers) {
  assert(a.size() > 0 && relative_cut >= 0.0);
  const Eigen::Index size = std::min(a.rows(), a.cols());
  const bool large = size >= least_size_to_compress;
  const bool symmetric = large && is_symmetric(a);
  const double target = well_below * relative_cut;
  if (large && target > rounding * std::sqrt(static_cast<double>(size))) {
    const Eigen::MatrixXd q = range_basis(a, target, workers);
    if (q.cols() > 0) return in_range(a, q, symmetric, workers);
  }
  SpectralFactors all;
  if (symmetric) {
    all = by_eigenvalues(std::move(a), {}, workers);
  } else {
    lapack::Svd svd = lapack::svd(a);
    all = {std::move(svd.u), svd.vt.transpose(), std::move(svd.s), true, std::move(svd.message)};
  }
  all.complete = true;
  return all;
}

}  // namespace knotlight
