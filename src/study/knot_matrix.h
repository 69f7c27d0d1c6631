// The boundary knot method's matrices in any arithmetic: more digits than double, or complex
// lambda. For double itself there is bkm/assembly.h.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "core/vec3.h"
#include "study/double_double.h"

namespace knotlight {

template <class T>
using MatrixOf = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

// G = sinh(lambda r)/(lambda r), and (dG/dr)/(lambda^2 r), both functions of s = (lambda r)^2:
//   sum s^j / (2j+1)!   and   sum s^j (2j+2) / (2j+3)!.
template <class T>
struct KnotWave {
  T value, slope;
};

// By the series: all terms have one sign for s >= 0, and no digit is lost.
template <class T>
KnotWave<T> knot_wave_series(const T& s) {
  using std::abs;
  T term = T(1.0), value = T(0.0), slope = T(0.0);
  for (int j = 0; abs(term) > Eigen::NumTraits<T>::epsilon() * abs(value); ++j) {
    const double n = 2.0 * j;
    value += term;
    slope += term * T(n + 2.0) / T((n + 2.0) * (n + 3.0));
    term = term * s / T((n + 2.0) * (n + 3.0));
  }
  return {value + term, slope};  // a last term that is not-a-number is not to be lost
}

inline KnotWave<double> knot_wave(double s) {
  return knot_wave_series(s);
}
inline KnotWave<DoubleDouble> knot_wave(const DoubleDouble& s) {
  return knot_wave_series(s);
}
// For complex s terms cancel: beyond |s| = 1 the closed form is the better one.
inline KnotWave<std::complex<double>> knot_wave(const std::complex<double>& s) {
  if (std::abs(s) < 1.0) return knot_wave_series(s);
  const std::complex<double> x = std::sqrt(s), value = std::sinh(x) / x;
  return {value, (std::cosh(x) - value) / s};
}

// Row = point, column = centre: G, and with `normals` (outward unit, one per point; else null) the
// Robin value G + k dG/dn. lambda_squared: 1/length^2; k: length.
template <class T>
MatrixOf<T> knot_matrix(const Points& points, const Points* normals, const Points& centers,
                        const T& lambda_squared, double k) {
  MatrixOf<T> a(points.cols(), centers.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      T square = T(0.0), along = T(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        const T d = T(points(axis, i)) - T(centers(axis, j));
        square += d * d;
        if (normals != nullptr) along += d * T((*normals)(axis, i));
      }
      const KnotWave<T> g = knot_wave(T(lambda_squared * square));
      a(i, j) = normals == nullptr ? g.value : g.value + T(k) * lambda_squared * g.slope * along;
    }
  return a;
}

}  // namespace knotlight
