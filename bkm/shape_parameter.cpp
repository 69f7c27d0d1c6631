#include "bkm/shape_parameter.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace knotlight {
namespace {

// Widths as powers of two of the knot spacing, in quarters of an octave.
constexpr int quarters = 4, narrowest = 0, widest = 4 * quarters;

}  // namespace

double default_shape_parameter() {
  return 8.0;
}

ShapeChoice leave_one_out_width(const Points& points, const Eigen::VectorXd& f,
                                RadialFunction radial, double spacing,
                                const AssemblyOptions& assembly, const DenseSolverOptions& solver) {
  assert(f.size() == points.cols() && has_width(radial.kind));
  const auto width = [&](int exponent) {
    return spacing * std::exp2(static_cast<double>(exponent) / quarters);
  };
  std::map<int, double> tried;  // error by exponent
  const auto try_width = [&](int exponent) {
    if (exponent < narrowest || exponent > widest || tried.contains(exponent)) return;
    radial.c = width(exponent);
    const auto matrix = [&] {
      Eigen::MatrixXd phi = source_matrix(points, radial, assembly);
      zero_tiny_entries(phi);
      return phi;
    };
    const Eigen::VectorXd errors = DenseSolver(matrix(), solver).leave_one_out(f);
    tried[exponent] = std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
  };
  const auto best = [&] {
    int at = narrowest;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [exponent, error] : tried)
      if (error < least) {  // never true of not-a-number
        least = error;
        at = exponent;
      }
    return std::pair(at, least);
  };

  for (int exponent = narrowest; exponent <= widest; exponent += quarters) try_width(exponent);
  for (int step = quarters / 2; step >= 1; step /= 2) {
    const int at = best().first;
    try_width(at - step);
    try_width(at + step);
  }
  const auto [at, error] = best();
  if (!std::isfinite(error))
    return {default_shape_parameter() * spacing, std::numeric_limits<double>::quiet_NaN(),
            static_cast<int>(tried.size())};
  return {width(at), error, static_cast<int>(tried.size())};
}

}  // namespace knotlight
