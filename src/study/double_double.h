// Numbers of 106 bits as unevaluated sums of two doubles [HLB01], for Eigen's factorisations. With
// no digits of its own to lose, a matrix of condition 1e25 shows what of a failure is rounding.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace knotlight {

// |lo| is at most half a unit in the last place of hi. What is not finite need not stay what it
// was: infinities become not-a-number.
struct DoubleDouble {
  double hi = 0.0, lo = 0.0;

  DoubleDouble() = default;
  DoubleDouble(double x) : hi(x) {}
  DoubleDouble(double larger, double smaller) : hi(larger), lo(smaller) {}
  explicit operator double() const { return hi + lo; }

  DoubleDouble operator-() const { return {-hi, -lo}; }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }

  // a + b as rounded, and what rounding left out: exact for |a| >= |b|, and for any a and b.
  static DoubleDouble quick_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  static DoubleDouble sum(double a, double b) {
    const double s = a + b, part = s - a;
    return {s, (a - (s - part)) + (b - part)};
  }

  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = sum(a.hi, b.hi), low = sum(a.lo, b.lo);
    const DoubleDouble once = quick_sum(high.hi, high.lo + low.hi);
    return quick_sum(once.hi, once.lo + low.lo);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const double p = a.hi * b.hi;
    return quick_sum(p, std::fma(a.hi, b.hi, -p) + (a.hi * b.lo + a.lo * b.hi));
  }
  // Long division, three digits to the base 2^53.
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.hi / b.hi;
    DoubleDouble rest = a - b * DoubleDouble(first);
    const double second = rest.hi / b.hi;
    rest = rest - b * DoubleDouble(second);
    return quick_sum(first, second) + DoubleDouble(rest.hi / b.hi);
  }

  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi == b.hi && a.lo == b.lo;
  }
  friend bool operator!=(const DoubleDouble& a, const DoubleDouble& b) { return !(a == b); }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return a < b || a == b; }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
};

inline DoubleDouble abs(const DoubleDouble& a) {
  return a.hi < 0.0 ? -a : a;
}
// One step of Newton's method from the root in double, which doubles its digits.
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (a.hi == 0.0) return {};
  const double root = std::sqrt(a.hi);
  const DoubleDouble square = DoubleDouble(root) * DoubleDouble(root);
  return DoubleDouble::quick_sum(root, (a - square).hi / (2.0 * root));
}

}  // namespace knotlight

namespace Eigen {

template <>
struct NumTraits<knotlight::DoubleDouble> : GenericNumTraits<knotlight::DoubleDouble> {
  using Real = knotlight::DoubleDouble;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 20,
    MulCost = 10
  };
  static Real epsilon() { return std::ldexp(1.0, -104); }  // of the products, two bits short
  static Real dummy_precision() { return std::ldexp(1.0, -90); }
  static Real highest() { return std::numeric_limits<double>::max(); }
  static Real lowest() { return std::numeric_limits<double>::lowest(); }
  static int digits10() { return 31; }
};

}  // namespace Eigen
