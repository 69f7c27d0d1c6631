#include "reference/slab_p1.h"

#include <Eigen/Dense>
#include <cassert>
#include <cmath>
#include <numbers>

namespace knotlight {

using std::numbers::pi;

// U'' - lambda^2 U = s e^(-sigma_t z) with s = source_per_U_ri / (4 pi): a multiple
// P = s / (sigma_t^2 - lambda^2) of the source solves it. The two exponentials of the homogeneous
// equation, each scaled to be 1 at its own face, are fixed by the Robin conditions
//   z = 0 (outward normal -z):  U - k U' = robin_data(-Q),   Q = g sigma_s e^(-sigma_t z),
//   z = thickness:              U + k U' = robin_data(+Q).
SlabP1::SlabP1(const Medium& medium, Boundary boundary, double thickness)
    : medium_(medium), c_(diffusion_coefficients(medium, boundary)), thickness_(thickness) {
  assert(medium.ior == 1.0);
  const double sigma_t = medium.sigma_t();
  const double beam = std::exp(-sigma_t * thickness);
  const double across = std::exp(-c_.lambda * thickness);
  const double Q_front = medium.g * medium.sigma_s;
  particular_ = c_.source_per_U_ri / (4.0 * pi) / (sigma_t * sigma_t - c_.lambda * c_.lambda);

  const double grow = 1.0 + c_.k * c_.lambda;
  const double fall = 1.0 - c_.k * c_.lambda;
  Eigen::Matrix2d rows;
  rows << grow, fall * across,  //
      fall * across, grow;
  const Eigen::Vector2d data(
      c_.robin_data(-Q_front) - particular_ * (1.0 + c_.k * sigma_t),
      c_.robin_data(Q_front * beam) - particular_ * (1.0 - c_.k * sigma_t) * beam);
  const Eigen::Vector2d amplitudes = rows.partialPivLu().solve(data);
  left_ = amplitudes[0];
  right_ = amplitudes[1];
}

double SlabP1::U_ri(double z) const {
  return std::exp(-medium_.sigma_t() * z) / (4.0 * pi);
}

double SlabP1::U_d(double z) const {
  return particular_ * std::exp(-medium_.sigma_t() * z) + left_ * std::exp(-c_.lambda * z) +
         right_ * std::exp(-c_.lambda * (thickness_ - z));
}

double SlabP1::reflected() const {
  return c_.leaving_flux(U_d(0.0));
}

double SlabP1::transmitted() const {
  return c_.leaving_flux(U_d(thickness_)) + std::exp(-medium_.sigma_t() * thickness_);
}

// sigma_a times the fluence 4 pi (U_ri + U_d), integrated term by term.
double SlabP1::absorbed() const {
  const double sigma_t = medium_.sigma_t();
  const double beam = (1.0 - std::exp(-sigma_t * thickness_)) / sigma_t;
  const double diffuse = (1.0 - std::exp(-c_.lambda * thickness_)) / c_.lambda;
  return medium_.sigma_a * (beam + 4.0 * pi * (particular_ * beam + (left_ + right_) * diffuse));
}

}  // namespace knotlight
