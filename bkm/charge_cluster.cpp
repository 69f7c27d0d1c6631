#include "bkm/charge_cluster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "bkm/factorial.h"

namespace knotlight {
namespace {

constexpr int P = cluster_degree;

constexpr double binomial(int n, int k) {
  return factorial(n) / (factorial(k) * factorial(n - k));
}

// The exponents of one degree's monomials, and the numbers that belong to them.
template <class Visit>
void for_degree(int n, Visit visit) {
  for (int i = monomials(n - 1); i < monomials(n); ++i) {
    const auto& e = monomial_table.exponents[static_cast<std::size_t>(i)];
    visit(i, e[0], e[1], e[2]);
  }
}

// (y + t)^a = product over the axes of sum_j binomial(a, j) t^(a-j) y^j: what the terms j < a of
// one axis add to a moment. From high exponents to low ones, so that what is read is still about
// the old centre.
struct ShiftTerm {
  std::uint8_t to, from, power;
  double binomial;
};
constexpr int shift_terms = [] {
  int count = 0;
  for (const auto& e : monomial_table.exponents) count += e[0];  // the same for every axis
  return count;
}();
constexpr auto shift_table = [] {
  std::array<std::array<ShiftTerm, static_cast<std::size_t>(shift_terms)>, 3> table{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t at = 0;
    for (int i = cluster_terms - 1; i > 0; --i) {
      std::array<int, 3> e = monomial_table.exponents[static_cast<std::size_t>(i)];
      const int n = e[axis];
      for (int j = 0; j < n; ++j) {
        e[axis] = j;
        table[axis][at++] = {static_cast<std::uint8_t>(i),
                             static_cast<std::uint8_t>(monomial_index(e[0], e[1], e[2])),
                             static_cast<std::uint8_t>(n - j), binomial(n, j)};
      }
    }
  }
  return table;
}();

// The homogeneous part of degree n of a polynomial: its Laplacian, of degree n - 2.
void laplacian(const MonomialSums& p, int n, MonomialSums& out) {
  for_degree(n - 2, [&](int i, int a, int b, int c) {
    out[i] = (a + 2) * (a + 1) * p[monomial_index(a + 2, b, c)] +
             (b + 2) * (b + 1) * p[monomial_index(a, b + 2, c)] +
             (c + 2) * (c + 1) * p[monomial_index(a, b, c + 2)];
  });
}

// out += factor * |x|^2 p, p homogeneous of degree n.
void add_times_square(const MonomialSums& p, int n, double factor, MonomialSums& out) {
  for_degree(n, [&](int i, int a, int b, int c) {
    out[monomial_index(a + 2, b, c)] += factor * p[i];
    out[monomial_index(a, b + 2, c)] += factor * p[i];
    out[monomial_index(a, b, c + 2)] += factor * p[i];
  });
}

}  // namespace

MonomialSums charge_moments(const DirectCharge* charges, std::size_t count) {
  // Eight charges at a time, each in its own lane; lanes are added up last.
  constexpr std::size_t lanes = 8;
  using EightLanes = Eigen::Array<double, lanes, 1>;
  std::array<EightLanes, cluster_terms> sums;
  sums.fill(EightLanes::Zero());
  std::array<EightLanes, cluster_terms> term;
  for (std::size_t first = 0; first < count; first += lanes) {
    std::array<EightLanes, 3> y;
    y.fill(EightLanes::Zero());
    EightLanes q = EightLanes::Zero();
    for (std::size_t i = first; i < std::min(first + lanes, count); ++i) {
      const auto lane = static_cast<Eigen::Index>(i - first);
      y[0][lane] = static_cast<double>(charges[i].x);
      y[1][lane] = static_cast<double>(charges[i].y);
      y[2][lane] = static_cast<double>(charges[i].z);
      q[lane] = static_cast<double>(charges[i].strength);
    }
    term[0] = q;
    sums[0] += q;
    for (std::size_t i = 1; i < cluster_terms; ++i) {
      term[i] = term[static_cast<std::size_t>(monomial_table.parent[i])] *
                y[static_cast<std::size_t>(monomial_table.axis[i])];
      sums[i] += term[i];
    }
  }
  MonomialSums moments;
  for (std::size_t i = 0; i < cluster_terms; ++i)
    moments[static_cast<Eigen::Index>(i)] = sums[i].sum();
  return moments;
}

MonomialSums shifted_moments(const MonomialSums& moments, const Vec3& shift) {
  MonomialSums result = moments;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, P + 1> power{1.0};
    for (std::size_t j = 1; j <= P; ++j)
      power[j] = power[j - 1] * shift[static_cast<Eigen::Index>(axis)];
    for (const ShiftTerm& term : shift_table[axis])
      result[term.to] += term.binomial * power[term.power] * result[term.from];
  }
  return result;
}

MonomialSums harmonic_coefficients(const MonomialSums& moments, double lambda) {
  MonomialSums p;
  for (int i = 0; i < cluster_terms; ++i) {
    const auto& e = monomial_table.exponents[static_cast<std::size_t>(i)];
    const double sign = (e[0] + e[1] + e[2]) % 2 == 0 ? 1.0 : -1.0;
    p[i] = sign * moments[i] / (factorial(e[0]) * factorial(e[1]) * factorial(e[2]));
  }
  // From the highest degree down: p_n = H_n + |x|^2 s, and lambda^2 s is added to p_(n-2).
  // H_n = sum_i (-1)^i (2n-2i-1)!! / ((2i)!! (2n-1)!!) |x|^(2i) Laplacian^i p_n [H31 ch. 4].
  for (int n = P; n >= 2; --n) {
    std::array<MonomialSums, P / 2 + 1> powers;  // Laplacian^i p_n
    powers[0] = p;
    for (int i = 1; 2 * i <= n; ++i)
      laplacian(powers[static_cast<std::size_t>(i - 1)], n - 2 * (i - 1),
                powers[static_cast<std::size_t>(i)]);
    // -s by Horner's rule in |x|^2, from the highest power of the Laplacian.
    MonomialSums rest = MonomialSums::Zero();
    for (int i = n / 2; i >= 1; --i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      const double factor = sign * double_factorial(2 * n - 2 * i - 1) /
                            (double_factorial(2 * i) * double_factorial(2 * n - 1));
      MonomialSums next = MonomialSums::Zero();
      if (2 * (i + 1) <= n) add_times_square(rest, n - 2 * (i + 1), 1.0, next);
      for_degree(n - 2 * i, [&](int j, int, int, int) {
        next[j] += factor * powers[static_cast<std::size_t>(i)][j];
      });
      rest = next;
    }
    add_times_square(rest, n - 2, 1.0, p);
    for_degree(n - 2, [&](int j, int, int, int) { p[j] -= lambda * lambda * rest[j]; });
  }
  return p;
}

TruncationBounds truncation_bounds(double r, double radius, double mean_square, double lambda,
                                   double grown) {
  const double x = lambda * r;
  const double scale = std::exp(-x) / (4.0 * std::numbers::pi);
  // All terms at rho = radius, without `scale`; those kept are taken off one after another.
  double value = grown / (r - radius);
  double slope = value * (lambda + 1.0 / (r - radius));
  // sum_{j<=n} x^j/j!, its last term, and radius^n / r^(n+1).
  double exponential = 1.0;
  double term = 1.0;
  double power = 1.0 / r;
  const double share = radius > 0.0 ? mean_square / (radius * radius) : 0.0;

  TruncationBounds bounds;
  for (std::size_t n = 0; n < bounds.value.size(); ++n) {  // the first term left out
    const double mean = n == 0 ? 1.0 : n == 1 ? std::sqrt(share) : share;
    // Rounding leaves less than nothing where the rest is below 1e-16 of the whole.
    bounds.value[n] = scale * mean * std::max(value, 0.0);
    bounds.derivative[n] = scale * mean * std::max(slope, 0.0);
    value -= exponential * power;
    term *= x / static_cast<double>(n + 1);
    exponential += term;
    slope -= static_cast<double>(n + 1) * exponential * power / r;
    power *= radius / r;
  }
  return bounds;
}

}  // namespace knotlight
