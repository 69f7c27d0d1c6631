// Statistical judgements with a stated false-alarm rate.
#pragma once

#include <cmath>
#include <vector>

namespace knotlight::test {

// Two-sided: a normal variate is further than this from its mean with probability 1e-6.
constexpr double z_one_in_a_million = 4.892;

// Mean and standard error of the mean of independent samples.
struct Mean {
  double sum = 0.0, sum_of_squares = 0.0;
  double n = 0.0;

  void add(double x) {
    sum += x;
    sum_of_squares += x * x;
    n += 1.0;
  }
  double mean() const { return sum / n; }
  double standard_error() const {
    return std::sqrt(std::max(0.0, sum_of_squares / n - mean() * mean()) / (n - 1.0));
  }
};

// Chi-square statistic of counts against expected counts, as a standard normal variate by the
// Wilson-Hilferty approximation; compare with z_one_in_a_million (one-sided, so half the rate).
inline double chi_square_z(const std::vector<double>& counts, const std::vector<double>& expected) {
  double chi2 = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    chi2 += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const double k = static_cast<double>(counts.size()) - 1.0;
  return (std::cbrt(chi2 / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

}  // namespace knotlight::test
