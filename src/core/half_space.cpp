#include "core/half_space.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "core/half_space_mode.h"
#include "core/phase_function.h"

namespace knotlight {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// With fewer streams the light that both comes and leaves at a cosine of 0.002 is off by more than
// 4e-3 of itself: their lowest node is at 0.0014.
constexpr int fewest_streams = 32;
// The time grows as their fourth power: the table of g = 0.95 takes 30 ms with these.
constexpr int most_streams = 64;
// Streams are added until what they cannot resolve of the phase function, g^(2 N), is below this:
// its effect on light scattered twice is small of second order.
constexpr double unresolved_peak = 1e-3;
// Modes are added until one is below this part of the first: they fall geometrically, at least as
// |g|^m, so that those left out are lost in the interpolation error.
constexpr double last_mode = 1e-5;

// Table positions per cosine and in azimuth, cubic between them. For g = 0.8 the interpolation is
// then off by at most 1e-3 of all light reflected, by 5e-5 in the root mean square.
constexpr int table_cosines = 48;
constexpr int table_angles = 32;

// The cosines of the table are equidistant in x = (1 - sin(theta))^(1/4), mu = cos(theta): at
// grazing angles the light goes as mu log(mu) and x as sqrt(mu), which bounds all slopes; about the
// normal it is smooth in theta, not in mu, and so is x.
double cosine_at(double x) {
  return x * x * std::sqrt(2.0 - x * x * x * x);
}
double position_of_cosine(double mu) {
  return std::sqrt(mu / std::sqrt(1.0 + std::sqrt(std::max(0.0, 1.0 - mu * mu))));
}
// The azimuths are equidistant in sin(phi / 2): densest about straight on.
double azimuth_at(double x) {
  return 2.0 * std::asin(x);
}
double position_of_azimuth(double cos_phi) {
  return std::sqrt(std::max(0.0, 0.5 * (1.0 - cos_phi)));
}

// Lagrange's cubic through four of the positions 0, 1 / (n - 1), ... 1.
struct Stencil {
  int first;
  std::array<double, 4> weight;
};
Stencil stencil(double position, int n) {
  const double x = position * (n - 1);
  const int first = std::clamp(static_cast<int>(x) - 1, 0, n - 4);
  const double a = x - first;
  const double b = a - 1.0;
  const double c = a - 2.0;
  const double d = a - 3.0;
  return {first, {-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0}};
}

std::size_t row(int mu, int mu0) {
  return static_cast<std::size_t>(mu) * table_cosines + mu0;
}

int streams_for(double g) {
  if (g == 0.0) return fewest_streams;
  const double needed = std::log(unresolved_peak) / (2.0 * std::log(std::abs(g)));
  return static_cast<int>(std::clamp(std::ceil(needed), 1.0 * fewest_streams, 1.0 * most_streams));
}

// p(Theta), unit 1/sr, of light that arrives along -mu0 and leaves along mu.
double phase(double mu, double mu0, double cos_phi, double g) {
  const double sines = std::sqrt(std::max(0.0, (1.0 - mu * mu) * (1.0 - mu0 * mu0)));
  return henyey_greenstein(std::clamp(sines * cos_phi - mu * mu0, -1.0, 1.0), g);
}

}  // namespace

// Delta-M [W77]: a forward peak too narrow for the streams, the part f = g^(2 N) of all scattering,
// counts as no scattering at all, which is an albedo of albedo (1 - f) / (1 - albedo f). What it
// does to light scattered once otherwise is then put back with the true phase function [NT88]. A
// backward peak (g < 0) cannot be taken for going on; there the series is cut.
HalfSpaceReflection::HalfSpaceReflection(double albedo, double g)
    : albedo_(albedo), g_(g), peak_(0.0), angles_(g == 0.0 ? 1 : table_angles) {
  assert(albedo >= 0.0 && albedo <= 1.0 && std::abs(g) < 1.0);
  const HalfSpaceStreams streams = half_space_streams(streams_for(g));
  const auto terms = static_cast<int>(2 * streams.mu.size());
  const double f = g > 0.0 ? std::pow(g, terms) : 0.0;
  VectorXd moments(terms);
  for (int l = 0; l < terms; ++l) moments[l] = (std::pow(g, l) - f) / (1.0 - f);
  const double scaled_albedo = albedo * (1.0 - f) / (1.0 - albedo * f);
  peak_ = albedo * albedo * f / (1.0 - albedo * f);

  VectorXd mu(table_cosines);
  for (int i = 0; i < table_cosines; ++i) mu[i] = cosine_at(i / (table_cosines - 1.0));

  constexpr int rows = table_cosines * table_cosines;
  MatrixXd modes(rows, terms);
  int used = 0;
  double first_size = 0.0;
  double size = 0.0;
  do {
    const MatrixXd mode = half_space_mode(streams, scaled_albedo, moments, used, mu);
    size = mode.cwiseAbs().maxCoeff();
    if (used == 0) first_size = size;
    modes.col(used++) = mode.reshaped();
  } while (used < terms && angles_ > 1 && size > last_mode * first_size);

  MatrixXd waves(used, angles_);
  for (int m = 0; m < used; ++m)
    for (int c = 0; c < angles_; ++c)
      waves(m, c) = m == 0 ? 1.0 : 2.0 * std::cos(m * azimuth_at(c / (angles_ - 1.0)));
  const MatrixXd values = modes.leftCols(used) * waves;
  table_.reserve(static_cast<std::size_t>(rows) * angles_);
  for (int i = 0; i < rows; ++i)
    for (int c = 0; c < angles_; ++c) table_.push_back(static_cast<float>(values(i, c)));
}

double HalfSpaceReflection::multiple(double mu, double mu0, double cos_phi) const {
  const Stencil a = stencil(position_of_cosine(mu), table_cosines);
  const Stencil b = stencil(position_of_cosine(mu0), table_cosines);
  double sum = 0.0;
  if (angles_ == 1) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        sum += a.weight[i] * b.weight[j] * table_[row(a.first + i, b.first + j)];
    return sum / (mu + mu0);
  }
  const Stencil c = stencil(position_of_azimuth(cos_phi), table_angles);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const float* at = &table_[row(a.first + i, b.first + j) * table_angles + c.first];
      sum +=
          a.weight[i] * b.weight[j] *
          (c.weight[0] * at[0] + c.weight[1] * at[1] + c.weight[2] * at[2] + c.weight[3] * at[3]);
    }
  }
  if (peak_ > 0.0) sum += peak_ * phase(mu, mu0, cos_phi, g_);
  // The ripples of a phase function cut short must not darken; NaN stays what it is.
  return std::max(sum, 0.0) / (mu + mu0);
}

double HalfSpaceReflection::single(double mu, double mu0, double cos_phi) const {
  return albedo_ * phase(mu, mu0, cos_phi, g_) / (mu + mu0);
}

}  // namespace knotlight
