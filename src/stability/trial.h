// One solve of one method on one exact boundary value problem, and how it came out.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "stability/body.h"

namespace knotlight {

// An exact solution of lap u - lambda^2 u = f, in closed form, of size 1 where it is largest on the
// surface or somewhat less.
struct ExactField {
  std::string name;
  std::function<double(const Vec3&)> value;
  std::function<Vec3(const Vec3&)> gradient;  // 1/length
};

// What is asked of every method: for each of the fields and each size of noise the field on the
// surface, from its Robin data.
struct BoundaryCase {
  const Body* body = nullptr;
  double lambda = 1.0;  // 1/length
  double k = 1.0;       // length
  std::vector<ExactField> fields;
  std::vector<double> noises;  // white, of the data, rms over the data's rms
  std::uint64_t seed = 1;
};

// lap u = lambda^2 u: the field of a point source at y outside, 1 at `foot`.
ExactField outer_source(const std::string& name, const Vec3& y, const Vec3& foot, double lambda);
// exp(s (w.x - 1)), w a unit vector: u of a source f = (s^2 - lambda^2) u, which dies out over 1/s
// along w, as light does that enters.
ExactField decaying_layer(const Vec3& w, double s);

// The lengths of a medium of this lambda R and reduced albedo < 1 under Marshak's condition without
// refraction, and two fields: `near`, of a source one transport mean free path above the surface,
// what the mirror image of light's first scattering is; `far`, of one at the distance R.
struct DiffusionScale {
  double sigma_tr = 1.0;  // 1/length
  double lambda = 1.0;    // 1/length
  double k = 1.0;         // length
};
DiffusionScale scale_of(const Body& body, double lambda_R, double albedo);
BoundaryCase source_case(const Body& body, double lambda_R, double albedo,
                         const std::vector<double>& noises, std::uint64_t seed);

// Figures that a method does not have are not-a-number.
struct Outcome {
  double error;  // largest on the surface over the largest |u|, at points that are not knots
  double unknowns;
  double rank;
  double condition;
  double coefficient_size;  // largest of sum |c_j w_j| over the largest |u|: what cancels
  double iterations;
};

// One line of the table.
struct Trial {
  std::string study, body, method, field;
  double lambda_R = 0.0, albedo = 0.0;
  std::string parameter;  // what `value` is
  double value = 0.0;
  double noise = 0.0;
  Outcome outcome{};
};

}  // namespace knotlight
