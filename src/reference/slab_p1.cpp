#include "reference/slab_p1.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace knotlight {
namespace {

using std::numbers::pi;

// P below loses as many digits as sigma_t and lambda share: at 1e-4 four of sixteen.
constexpr double nearest_to_resonance = 1e-4;

// Solutions of u'' = lambda^2 u about the middle of the slab, y = z - d/2, h = d/2, scaled so that
// nothing overflows:
//   even(y) = cosh(lambda y) / cosh(lambda h),   odd(y) = sinh(lambda y) / (lambda cosh(lambda h)).
// They exist for lambda = 0 too: 1 and y.
struct HomogeneousPair {
  double lambda, h;

  double even(double y) const {
    return (std::exp(lambda * (std::abs(y) - h)) + std::exp(-lambda * (std::abs(y) + h))) /
           (1.0 + std::exp(-2.0 * lambda * h));
  }
  double odd(double y) const {
    if (lambda * h < small) return y * (1.0 + std::pow(lambda * y, 2) / 6.0) / cosh_of_small();
    const double size = std::abs(y);
    return std::copysign((std::exp(lambda * (size - h)) - std::exp(-lambda * (size + h))) /
                             (lambda * (1.0 + std::exp(-2.0 * lambda * h))),
                         y);
  }
  // Slopes at y = h: even' = lambda tanh(lambda h), odd' = 1.
  double even_slope_at_face() const { return lambda * std::tanh(lambda * h); }
  // Integral of `even` over the slab; that of `odd` is 0.
  double even_integral() const {
    return lambda * h < small ? 2.0 * h * (1.0 - std::pow(lambda * h, 2) / 3.0)
                              : 2.0 * std::tanh(lambda * h) / lambda;
  }
  // Amplitudes for the Robin data `front` and `back` at y = -h, h: the sum of both conditions
  // u + k du/dn holds the even part alone, the difference the odd part.
  double even_amplitude(double front, double back, double k) const {
    return 0.5 * (front + back) / (1.0 + k * even_slope_at_face());
  }
  double odd_amplitude(double front, double back, double k) const {
    return 0.5 * (back - front) / (odd(h) + k);
  }

 private:
  static constexpr double small = 1e-3;  // the next terms of the series are below 1e-13
  double cosh_of_small() const { return std::cosh(lambda * h); }
};

HomogeneousPair homogeneous(const P1Constants& c, double thickness) {
  return {c.lambda, 0.5 * thickness};
}

}  // namespace

// Beam. With r the reflectance of a face and B = e^(-sigma_t d), irradiance D enters downwards at
// z = 0 and V starts upwards at z = d:  D = 1 - r + r B V,  V = r B D, so D = (1-r)/(1 - r^2 B^2).
//
// Diffusion. U'' - lambda^2 U = s (D e^(-sigma_t z) + V e^(-sigma_t (d - z))) with
// s = per_U_ri / (4 pi): the multiple P = s / (sigma_t^2 - lambda^2) of the beams solves it,
// and the homogeneous pair mends the Robin conditions
//   z = 0 (outward normal -z):  U - k U' = -per_Q Q_z,   Q_z = g sigma_s (down - up),
//   z = d:                      U + k U' = +per_Q Q_z.
SlabP1::SlabP1(const Medium& medium, Boundary boundary, double thickness)
    : medium_(medium), c_(p1_constants(medium, boundary)), thickness_(thickness) {
  const double sigma_t = medium.sigma_t();
  if (std::abs(sigma_t - c_.lambda) < nearest_to_resonance * sigma_t)
    throw std::domain_error("SlabP1: sigma_t equals the diffusion exponent, expected another");
  const double across = std::exp(-sigma_t * thickness);
  face_reflectance_ = reflectance_from_inside(0.0, medium.ior);
  const double r = face_reflectance_;
  down_ = (1.0 - r) / (1.0 - r * r * across * across);
  up_ = r * across * down_;
  particular_ = c_.per_U_ri / (4.0 * pi) / (sigma_t * sigma_t - c_.lambda * c_.lambda);

  // The particular part's own u + k du/dn: each beam falls off along its direction.
  const double against = 1.0 + c_.k * sigma_t;  // at the face where the beam starts
  const double along = 1.0 - c_.k * sigma_t;    // where it ends
  const double front =
      -c_.per_Q * Q_ri_z(0.0) - particular_ * (against * down_ + along * up_ * across);
  const double back =
      c_.per_Q * Q_ri_z(thickness) - particular_ * (along * down_ * across + against * up_);
  const HomogeneousPair pair = homogeneous(c_, thickness);
  even_ = pair.even_amplitude(front, back, c_.k);
  odd_ = pair.odd_amplitude(front, back, c_.k);
}

double SlabP1::U_ri(double z) const {
  const double sigma_t = medium_.sigma_t();
  return (down_ * std::exp(-sigma_t * z) + up_ * std::exp(-sigma_t * (thickness_ - z))) /
         (4.0 * pi);
}

double SlabP1::Q_ri_z(double z) const {
  const double sigma_t = medium_.sigma_t();
  return medium_.g * medium_.sigma_s *
         (down_ * std::exp(-sigma_t * z) - up_ * std::exp(-sigma_t * (thickness_ - z)));
}

double SlabP1::U_d(double z) const {
  const HomogeneousPair pair = homogeneous(c_, thickness_);
  const double y = z - 0.5 * thickness_;
  return 4.0 * pi * particular_ * U_ri(z) + even_ * pair.even(y) + odd_ * pair.odd(y);
}

double SlabP1::diffusely_reflected() const {
  return c_.out_per_U * U_d(0.0);
}

double SlabP1::diffusely_transmitted() const {
  return c_.out_per_U * U_d(thickness_);
}

double SlabP1::unscattered_reflected() const {
  return face_reflectance_ +
         (1.0 - face_reflectance_) * up_ * std::exp(-medium_.sigma_t() * thickness_);
}

double SlabP1::unscattered_transmitted() const {
  return (1.0 - face_reflectance_) * down_ * std::exp(-medium_.sigma_t() * thickness_);
}

// sigma_a times the fluence 4 pi (U_ri + U_d), integrated term by term.
double SlabP1::absorbed() const {
  const double sigma_t = medium_.sigma_t();
  const double beams = (down_ + up_) * -std::expm1(-sigma_t * thickness_) / sigma_t;
  return medium_.sigma_a *
         (beams +
          4.0 * pi * (particular_ * beams + even_ * homogeneous(c_, thickness_).even_integral()));
}

// No source inside; at z = 0 (outward normal -z) U - k U' = ((1 + A)/2) E'/pi with E' = 1, at
// z = d U + k U' = 0. From P1, F.n = -(4 pi / 3 sigma_tr) dU/dn = 2 pi U / A - (1 + A)/A E', and
// what leaves is F.n + E'.
DiffuseSlabP1::DiffuseSlabP1(const Medium& medium, Boundary boundary, double thickness)
    : medium_(medium), c_(p1_constants(medium, boundary)), thickness_(thickness) {
  const HomogeneousPair pair = homogeneous(c_, thickness);
  const double front = 0.5 * (1.0 + c_.A) / pi;
  even_ = pair.even_amplitude(front, 0.0, c_.k);
  odd_ = pair.odd_amplitude(front, 0.0, c_.k);
}

double DiffuseSlabP1::U(double z) const {
  const HomogeneousPair pair = homogeneous(c_, thickness_);
  const double y = z - 0.5 * thickness_;
  return even_ * pair.even(y) + odd_ * pair.odd(y);
}

double DiffuseSlabP1::reflected() const {
  return c_.out_per_U * U(0.0) - 1.0 / c_.A;
}

double DiffuseSlabP1::transmitted() const {
  return c_.out_per_U * U(thickness_);
}

double DiffuseSlabP1::absorbed() const {
  return 4.0 * pi * medium_.sigma_a * even_ * homogeneous(c_, thickness_).even_integral();
}

}  // namespace knotlight
