// A cluster of charges seen from afar. With d = x - c, c the cluster's centre, and y - c the place
// of a charge in it, the field is Taylor's series in y - c,
//
//   u(x) = sum_a (-1)^|a| M_a / a! D^a G(d),   M_a = sum q (y - c)^a,   G(r) = exp(-lambda r)/(4 pi
//   r).
//
// The polynomial M_a / a! D^a in the derivatives is split into powers of D.D, which act on G as
// lambda^2, times harmonic polynomials H_m, for which H_m(D) G = H_m(d) f_m(r) with
// f_m = ((1/r) d/dr)^m G (Hobson's theorem [H31 ch. 4]). There remain 7 radial functions and one
// polynomial:
//
//   u(x) = sum_m f_m(r) H_m(d).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "bkm/charge_lanes.h"
#include "core/vec3.h"

namespace knotlight {

// Degree of the expansions. Six is where a point with a cluster costs as much as with eight
// charges.
constexpr int cluster_degree = 6;

// Number of monomials x^a y^b z^c of degree <= n.
constexpr int monomials(int n) {
  return (n + 1) * (n + 2) * (n + 3) / 6;
}
constexpr int cluster_terms = monomials(cluster_degree);

// All monomials up to cluster_degree, by degree. Each one but the first is a former one, `parent`,
// times the coordinate `axis`.
struct MonomialTable {
  std::array<std::array<int, 3>, cluster_terms> exponents{};
  std::array<int, cluster_terms> parent{};
  std::array<int, cluster_terms> axis{};
};
constexpr int monomial_index(int a, int b, int c) {
  const int n = a + b + c;
  // Those of lower degree; in degree n by falling a, then by falling b.
  return monomials(n - 1) + (n - a) * (n - a + 1) / 2 + c;
}
constexpr MonomialTable make_monomial_table() {
  MonomialTable table;
  for (int n = 0; n <= cluster_degree; ++n)
    for (int a = n; a >= 0; --a)
      for (int b = n - a; b >= 0; --b) {
        const int c = n - a - b;
        const auto i = static_cast<std::size_t>(monomial_index(a, b, c));
        table.exponents[i] = {a, b, c};
        if (n == 0) continue;
        table.axis[i] = a > 0 ? 0 : b > 0 ? 1 : 2;
        table.parent[i] = a > 0   ? monomial_index(a - 1, b, c)
                          : b > 0 ? monomial_index(a, b - 1, c)
                                  : monomial_index(a, b, c - 1);
      }
  return table;
}
constexpr MonomialTable monomial_table = make_monomial_table();

// One number per monomial: moments, or the coefficients of a polynomial.
using MonomialSums = Eigen::Array<double, cluster_terms, 1>;

// sum q y^a over charges, whose positions are relative to the centre.
MonomialSums charge_moments(const DirectCharge* charges, std::size_t count);
// The moments about another centre: every y becomes y + shift. Exact.
MonomialSums shifted_moments(const MonomialSums& moments, const Vec3& shift);
// Coefficients of H_0 + H_1 + ... from the moments; lambda in the unit of the moments.
MonomialSums harmonic_coefficients(const MonomialSums& moments, double lambda);

// What the expansion, cut off at a degree, leaves out, per unit of absolute strength of a cluster
// whose charges lie within `radius` of its centre and have the mean square distance `mean_square`
// from it, at distances >= r of the centre: bounds for the value and any directional derivative.
//
// Derivation: G(x - y) = (lambda/4pi) sum_l (2l+1) i_l(lambda rho) k_l(lambda r) P_l(cos angle)
// [AS64 10.2.35], and i_l is a power series with positive coefficients: the term of degree n in
// rho is largest where all P_l = 1, in the direction of the point, and there it is the n-th term of
// exp(-lambda (r - rho))/(4 pi (r - rho)):
//   h_n rho^n,   4 pi h_n = exp(-x) r^-(n+1) sum_{j<=n} x^j/j!,   x = lambda r.
// A derivative turns the term into a symmetric form of n + 1 vectors, n of them y, which is largest
// where all are parallel: (n + 1) h_(n+1) rho^n. The terms left out are the whole less those kept;
// their mean over the cluster is at most (mean rho^2/radius^2) of what they are at its radius, if
// they start at rho^2. (The harmonics kept hold a share of the terms left out, up to degree 6; what
// is left out is then less.)
struct TruncationBounds {
  // Per degree of cut-off; [0] is for dropping the cluster altogether, [1 + p] for degree p.
  std::array<double, cluster_degree + 2> value;
  std::array<double, cluster_degree + 2> derivative;
};
// r > radius; grown = exp(lambda radius).
TruncationBounds truncation_bounds(double r, double radius, double mean_square, double lambda,
                                   double grown);

}  // namespace knotlight
