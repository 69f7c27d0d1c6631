#include "bkm/spherical_waves.h"

#include <cassert>
#include <cmath>

namespace knotlight {
namespace {

// s_l(t) = (2l+1)!! i_l(x) / x^l with t = x^2/2 [AS64 10.2.5]:
//   s_l = sum_j t^j / (j! (2l+3)(2l+5)...(2l+2j+1)),   ds_l/dt = s_(l+1) / (2l+3).
// All terms are positive: no digits are lost at any t.
double reduced_bessel(int l, double t) {
  double term = 1.0;
  double sum = 1.0;
  for (int j = 1; term > 1e-17 * sum; ++j) {
    term *= t / (j * (2.0 * l + 2.0 * j + 1.0));
    sum += term;
  }
  return sum;
}

// s_0 .. s_top at t: the two highest by series, the others by the recurrence downwards,
// s_(l-1) = s_l + 2 t s_(l+1) / ((2l+1)(2l+3)), whose terms are positive too.
void reduced_bessels(int top, double t, double* s) {
  s[top] = reduced_bessel(top, t);
  if (top == 0) return;
  s[top - 1] = reduced_bessel(top - 1, t);
  for (int l = top - 1; l > 0; --l)
    s[l - 1] = s[l] + 2.0 * t * s[l + 1] / ((2.0 * l + 1.0) * (2.0 * l + 3.0));
}

}  // namespace

SphericalWaves::SphericalWaves(int degree, double lambda, double rho)
    : degree_(degree), lambda_(lambda), rho_(rho) {
  assert(degree >= 0 && degree <= max_degree);
  double s[max_degree + 2];
  reduced_bessels(degree_ + 1, 0.5 * lambda * lambda * rho * rho, s);
  for (int l = 0; l <= degree_; ++l) {
    scale_[l] = 1.0 / s[l];
    double ratio = 2.0 * l + 1.0;  // (2l+1) (l-m)! / (l+m)!
    norm_[l][0] = std::sqrt(ratio);
    for (int m = 1; m <= l; ++m) {
      ratio /= (l + m) * (l - m + 1.0);
      norm_[l][m] = std::sqrt(2.0 * ratio);
    }
  }
}

// Real solid harmonics r^l Y_lm = norm Pi_l^m(z, r^2) {C_m, S_m}(x, y), C_m + i S_m = (x + iy)^m,
//   Pi_m^m = (2m-1)!!,  (l-m) Pi_l^m = (2l-1) z Pi_(l-1)^m - (l+m-1) r^2 Pi_(l-2)^m,
// the recurrence of the associated Legendre functions times r^(l-m). In units of rho.
void SphericalWaves::evaluate(const Vec3& at, double* value, double* gradient) const {
  const double x = at.x() / rho_, y = at.y() / rho_, z = at.z() / rho_;
  const double r2 = x * x + y * y + z * z;
  const double half = 0.5 * lambda_ * lambda_ * rho_ * rho_;
  double s[max_degree + 2];
  reduced_bessels(degree_ + 1, half * r2, s);

  double c = 1.0, d = 0.0;                // C_m, S_m
  double c_before = 0.0, d_before = 0.0;  // of m - 1
  double sectoral = 1.0;                  // (2m-1)!!
  for (int m = 0; m <= degree_; ++m) {
    double p = sectoral, p_z = 0.0, p_r = 0.0;            // Pi_l^m and its derivatives by z and r^2
    double before = 0.0, before_z = 0.0, before_r = 0.0;  // of l - 1
    for (int l = m; l <= degree_; ++l) {
      const double radial = s[l] * scale_[l] * norm_[l][m];
      const int j = l * l + (m == 0 ? 0 : 2 * m - 1);
      value[j] = radial * p * c;
      if (m > 0) value[j + 1] = radial * p * d;
      if (gradient != nullptr) {
        // d radial / d r^2
        const double slope = half * s[l + 1] / (2.0 * l + 3.0) * scale_[l] * norm_[l][m];
        const double along = 2.0 * (slope * p + radial * p_r);
        const auto write = [&](int column, double f, double f_x, double f_y) {
          double* g = gradient + 3 * column;
          g[0] = (along * x * f + radial * p * f_x) / rho_;
          g[1] = (along * y * f + radial * p * f_y) / rho_;
          g[2] = (along * z + radial * p_z) * f / rho_;
        };
        write(j, c, m * c_before, -m * d_before);
        if (m > 0) write(j + 1, d, m * d_before, m * c_before);
      }
      const double a = (2.0 * l + 1.0) / (l - m + 1.0), b = (l + m) / (l - m + 1.0);
      const double next = a * z * p - b * r2 * before;
      const double next_z = a * (p + z * p_z) - b * r2 * before_z;
      const double next_r = a * z * p_r - b * (before + r2 * before_r);
      before = p, before_z = p_z, before_r = p_r;
      p = next, p_z = next_z, p_r = next_r;
    }
    c_before = c, d_before = d;
    const double turned = x * c - y * d;
    d = x * d + y * c;
    c = turned;
    sectoral *= 2.0 * m + 1.0;
  }
}

void SphericalWaves::values(const Vec3& x, Eigen::Ref<Eigen::VectorXd> row) const {
  evaluate(x, row.data(), nullptr);
}

void SphericalWaves::robin(const Vec3& x, const Vec3& n, double k,
                           Eigen::Ref<Eigen::VectorXd> row) const {
  double gradient[3 * max_size];
  evaluate(x, row.data(), gradient);
  row += k * Eigen::Map<const Eigen::Matrix3Xd>(gradient, 3, size()).transpose() * n;
}

double SphericalWaves::sum(const Vec3& x, const Eigen::Ref<const Eigen::VectorXd>& beta) const {
  double value[max_size];
  evaluate(x, value, nullptr);
  return Eigen::Map<const Eigen::VectorXd>(value, size()).dot(beta);
}

Vec3 SphericalWaves::gradient(const Vec3& x, const Eigen::Ref<const Eigen::VectorXd>& beta) const {
  double value[max_size];
  double gradient[3 * max_size];
  evaluate(x, value, gradient);
  return Eigen::Map<const Eigen::Matrix3Xd>(gradient, 3, size()) * beta;
}

}  // namespace knotlight
