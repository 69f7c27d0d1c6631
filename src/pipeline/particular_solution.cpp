#include "pipeline/particular_solution.h"

#include <cmath>

#include "pipeline/photon_sources.h"

namespace knotlight {
namespace {

// lap u - lambda^2 u = 1 about a centre: u = (sinh(x)/x - 1) / lambda^2 with x = lambda r, which
// stays r^2/6 where lambda is small; where lambda R is large it would overflow, and the constant
// -1/lambda^2 is as good. The largest lambda R with the former: sinh(x)/x is then 10.
constexpr double most_absorption_lengths = 4.5;

struct Uniform {
  double value = 0.0;
  double slope_over_r = 0.0;  // (du/dr) / r
};

Uniform uniform_solution(double lambda, double r, double R) {
  if (lambda * R > most_absorption_lengths) return {-1.0 / (lambda * lambda), 0.0};
  // sum_j t^j / ((2j+3)!) lambda^.. : u = r^2 (1/3! + x^2/5! + x^4/7! + ...), term by term.
  const double x2 = lambda * lambda * r * r;
  double term = 1.0 / 6.0;
  Uniform u;
  for (int j = 1; term > 1e-17 * u.value; ++j) {
    u.value += term;
    u.slope_over_r += 2.0 * j * term;
    term *= x2 / ((2.0 * j + 2.0) * (2.0 * j + 3.0));
  }
  u.value *= r * r;
  return u;
}

}  // namespace

ParticularSolution::ParticularSolution(const ChannelProblem& p, const PhotonSumOptions& options)
    : lambda_(p.coefficients.lambda),
      emitted_(p.coefficients.source_per_E * p.medium.emission),
      center_(sphere_around({&p.shape}).center),
      radius_(sphere_around({&p.shape}).radius),
      k_(p.coefficients.k) {
  for (std::size_t half = 0; half < 2; ++half) {
    PointSources sources = photon_sources(p, static_cast<int>(half));
    layers_[half] = std::make_unique<const EndLayer>(sources, lambda_);
    sums_[half] =
        std::make_unique<const PhotonSum>(std::move(sources), lambda_, k_, options, p.workers);
  }
}

ParticularValues ParticularSolution::evaluate(const Points& x, const Points* normals,
                                              const Workers& workers) const {
  ParticularValues result;
  for (std::size_t half = 0; half < 2; ++half) {
    PhotonSumValues sum = sums_[half]->evaluate(x, normals, workers);
    result.value[half] = std::move(sum.value);
    result.normal_derivative[half] = std::move(sum.normal_derivative);
    if (normals == nullptr) continue;
    result.surface_data[half] = k_ * layers_[half]->density(x, *normals, workers);
  }
  if (emitted_ == 0.0) return result;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 d = x.col(i) - center_;
    const Uniform u = uniform_solution(lambda_, d.norm(), radius_);
    for (std::size_t half = 0; half < 2; ++half) {
      result.value[half][i] += emitted_ * u.value;
      if (normals != nullptr)
        result.normal_derivative[half][i] += emitted_ * u.slope_over_r * d.dot(normals->col(i));
    }
  }
  return result;
}

std::size_t ParticularSolution::charges() const {
  return sums_[0]->charges() + sums_[1]->charges();
}

}  // namespace knotlight
