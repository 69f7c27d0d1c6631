// The inner loops of the photon sum: sixteen points at once against a cluster's expansion or
// against single charges, in float. Positions are relative to the centre of the cluster, so that
// rounding is a share of its size, however small it is.
#pragma once

#include <cstdint>

namespace knotlight {

constexpr int lane_count = 16;

// One number for each of the sixteen points, in a vector register where the processor has them.
using Lanes [[gnu::vector_size(lane_count * sizeof(float))]] = float;

struct LanePoints {
  Lanes x, y, z;     // relative to the cluster's centre
  Lanes nx, ny, nz;  // unit normals; read only for derivatives
};

// Sums over charges, without the factor 1/(4 pi). Derivatives are along the normals.
struct LaneSums {
  Lanes value;
  Lanes derivative;
  Lanes magnitude;        // of absolute strengths: sum |q| G
  Lanes slope_magnitude;  // sum |q| |G'|
};

struct DirectCharge {
  float x, y, z;  // relative to the centre
  float strength;
};

// The field of a ball of charge 1, radius^2 = `square`, for the inside: 4 pi u = sum of
// `value`[i] r^(2i), and 4 pi u' / r = sum of `slope`[i] r^(2i).
struct BallField {
  static constexpr int terms = 6;
  float square = 0.0F;  // 0: point charges
  float value[terms] = {};
  float slope[terms] = {};
};
// radius > 0 with lambda * radius <= 1; the field outside is that of a point charge 1.
BallField ball_field(double radius, double lambda);

// Adds the fields of the charges. lambda in 1/length.
void add_charges(const LanePoints& points, const DirectCharge* charges, std::uint32_t count,
                 float lambda, const BallField& ball, bool derivatives, LaneSums& sums);

// Adds sum_m f_m(r) H_m(d), m <= degree (charge_cluster.h), to value and derivative. Lengths in
// units of a length of the cluster, so that powers of r stay within the range of float: derivatives
// come out per that unit.
void add_cluster(const LanePoints& points, const float* coefficients, int degree, float lambda,
                 bool derivatives, LaneSums& sums);

}  // namespace knotlight
