#include "pipeline/residual_effect.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace knotlight {
namespace {

// One-sided chance of a normal variable beyond so many: 2 %.
constexpr double standard_errors = 2.0;
constexpr std::size_t rows_per_chunk = 16;

// e has the spectrum residual / (1 + k w), so its mean square is the double integral over the
// surface of residual(x) residual(y) M(|x - y|), M of spectrum (1 + k w)^-2 (lambda, which makes e
// smaller yet, is left out). With 1/a^2 = int_0^inf t exp(-a t) dt and the inverse transform of
// exp(-z w), Poisson's kernel z / (2 pi (z^2 + d^2)^(3/2)):
//   M(d) = int_0^inf t exp(-t) t k / (2 pi ((t k)^2 + d^2)^(3/2)) dt.
// Here times 2 pi k^2, at d = distance / k, tabulated over log d.
class SmoothingKernel {
 public:
  SmoothingKernel() {
    for (int i = 0; i <= intervals; ++i)
      table_.push_back(std::log(integral(std::exp(first + step * i))));
  }
  double operator()(double d) const {
    const double place =
        std::clamp((std::log(d) - first) / step, 0.0, static_cast<double>(intervals) - 1e-9);
    const auto i = static_cast<std::size_t>(place);
    const double s = place - static_cast<double>(i);
    return std::exp((1.0 - s) * table_[i] + s * table_[i + 1]);
  }

 private:
  // M grows as log(1/d) below and falls as d^-3 above: beyond the ends nothing that counts happens.
  static constexpr double first = -9.0, last = 9.0;
  static constexpr int intervals = 360;
  static constexpr double step = (last - first) / intervals;

  // In log t, where the integrand is smooth: the trapezoidal rule.
  static double integral(double d) {
    constexpr double from = -20.0, width = 0.05;
    constexpr int steps = 500;  // up to log t = 5
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double t = std::exp(from + width * i);
      sum += width * t * t * t * std::exp(-t) / std::pow(t * t + d * d, 1.5);
    }
    return sum;
  }

  std::vector<double> table_;
};

}  // namespace

double mean_square_effect(const Points& positions, const std::array<Eigen::VectorXd, 2>& residuals,
                          double k, const Workers& workers) {
  static const SmoothingKernel kernel;
  const Eigen::Index n = positions.cols();
  if (n < 2) return 0.0;
  // The means over all pairs of two different points, row by row. A residual that is the same
  // everywhere is to give itself: weights are divided by their sum.
  struct Row {
    double products = 0.0, weights = 0.0, squares = 0.0;
  };
  std::vector<Row> rows(static_cast<std::size_t>(n));
  workers.for_chunks(
      rows.size(), rows_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
          const auto i = static_cast<Eigen::Index>(row);
          for (Eigen::Index j = 0; j < n; ++j) {
            if (j == i) continue;
            const double w = kernel((positions.col(i) - positions.col(j)).norm() / k);
            rows[row].products += w * residuals[0][i] * residuals[1][j];
            rows[row].weights += w;
            rows[row].squares += w * w;
          }
        }
      });
  Row sum;
  for (const Row& row : rows) {
    sum.products += row.products;
    sum.weights += row.weights;
    sum.squares += row.squares;
  }
  const double common = std::abs(residuals[0].dot(residuals[1])) / static_cast<double>(n);
  // Of a residual without any order: each pair counts twice in the sums.
  const double standard_error = common * std::sqrt(2.0 * sum.squares) / sum.weights;
  return std::min(common,
                  std::max(0.0, sum.products / sum.weights) + standard_errors * standard_error);
}

}  // namespace knotlight
