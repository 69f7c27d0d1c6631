#include "reference/p1.h"

#include <cmath>
#include <numbers>

#include "reference/legendre.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// Extrapolation lengths in transport mean free paths: P1 and Milne's problem [CdH53].
constexpr double extrapolation_p1 = 2.0 / 3.0;
constexpr double extrapolation_milne = 0.7104;

constexpr int moment_points = 64;  // the integrand ends in a square root at the critical angle, at
                                   // the end of a panel: error below 1e-7

}  // namespace

// Fresnel's sine and tangent laws, (sin(a-b)/sin(a+b))^2 and (tan(a-b)/tan(a+b))^2, and their limit
// ((n-1)/(n+1))^2 for a ray along the normal.
double reflectance_from_inside(double inside, double ior) {
  if (ior == 1.0) return 0.0;
  const double s = ior * std::sin(inside);
  if (s >= 1.0) return 1.0;
  const double outside = std::asin(s);
  constexpr double along_normal = 1e-6;  // the laws are 0/0 there, the limit is right to its square
  if (inside < along_normal) return std::pow((ior - 1.0) / (ior + 1.0), 2);
  const double across = std::sin(outside - inside) / std::sin(outside + inside);
  const double along = std::tan(outside - inside) / std::tan(outside + inside);
  return 0.5 * (across * across + along * along);
}

// The two moments over the hemisphere, R_phi = int 2 cos sin R da, R_j = int 3 cos^2 sin R da:
// up to the critical angle by Gauss points, beyond it, where R = 1, exactly.
double internal_reflection_A(double ior) {
  if (ior == 1.0) return 1.0;
  const double critical = ior > 1.0 ? std::asin(1.0 / ior) : 0.5 * pi;
  double R_phi = std::pow(std::cos(critical), 2);
  double R_j = std::pow(std::cos(critical), 3);
  const Quadrature gauss = gauss_legendre(moment_points);
  for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
    // t^2 spreads the points towards the critical angle and takes the square root away.
    const double t = 0.5 * (1.0 + gauss.nodes[i]);
    const double angle = critical * (1.0 - t * t);
    const double weight = 0.5 * gauss.weights[i] * 2.0 * critical * t;
    const double R = reflectance_from_inside(angle, ior);
    R_phi += weight * 2.0 * std::cos(angle) * std::sin(angle) * R;
    R_j += weight * 3.0 * std::pow(std::cos(angle), 2) * std::sin(angle) * R;
  }
  const double R = (R_phi + R_j) / (2.0 - R_phi + R_j);
  return (1.0 + R) / (1.0 - R);
}

// Fluence 4 pi U, flux F, absorption a, transport coefficient t = a + (1 - g) s, D = 1 / (3 t).
//   balance   div F = -a 4 pi U + s 4 pi U_ri + E
//   Fick      F = -D grad(4 pi U) + Q_ri / t
// Put the second into the first and divide by -4 pi D:
//   lap U - (a / D) U = -(s / D) U_ri - E / (4 pi D) + div Q_ri / (4 pi D t)
// and div Q_ri = g s div F_ri = -g s sigma_t 4 pi U_ri, light of the first flight dying out. The
// last term is then -(g s sigma_t / (D t)) U_ri = -3 g s sigma_t U_ri.
//
// Surface. P1 sends pi U -+ F.n / 2 through a plane either way. Of what goes out a share comes
// back; with A for both moments of it, F.n = 2 pi U / A. Fick again: U + 2 A D dU/dn = A Q_ri . n /
// (2 pi t).
P1Constants p1_constants(const Medium& medium, Boundary boundary) {
  const double a = medium.sigma_a, s = medium.sigma_s, g = medium.g;
  const double t = a + s - g * s;
  const double D = 1.0 / (3.0 * t);
  P1Constants c;
  c.A = internal_reflection_A(medium.ior) *
        (boundary == Boundary::milne ? extrapolation_milne / extrapolation_p1 : 1.0);
  c.lambda = std::sqrt(a / D);
  c.k = 2.0 * c.A * D;
  c.per_U_ri = -s / D - 3.0 * g * s * (a + s);
  c.per_E = -1.0 / (4.0 * pi * D);
  c.per_Q = c.A / (2.0 * pi * t);
  c.out_per_U = 2.0 * pi / c.A;
  return c;
}

}  // namespace knotlight
