#include "bkm/charge_lanes.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bkm/charge_cluster.h"

namespace knotlight {
namespace {

using LaneInts [[gnu::vector_size(lane_count * sizeof(int))]] = int;

Lanes all(float value) {
  return value - Lanes{};
}

LaneInts bits(Lanes v) {
  return reinterpret_cast<LaneInts>(v);
}
Lanes from_bits(LaneInts v) {
  return reinterpret_cast<Lanes>(v);
}

// 1/sqrt(s), s > 0, to 2e-7: the exponent halved by integer arithmetic, and three Newton steps.
// Large, but finite for s = 0.
Lanes inverse_root(Lanes s) {
  Lanes y = from_bits(0x5f375a86 - (bits(s) >> 1));
  const Lanes half = 0.5F * s;
  for (int step = 0; step < 3; ++step) y = y * (1.5F - half * y * y);
  return y;
}

// exp(-x), x >= 0, relative error 3e-7 up to x = 80 (1e-35), where it stays: 2^n 2^f, |f| <= 1/2.
Lanes decay(Lanes x) {
  constexpr float log2_e = 1.44269504F;
  // Adding and taking away 1.5 * 2^23 leaves the nearest integer.
  constexpr float rounding = 12582912.0F;
  x = x < 80.0F ? x : all(80.0F);
  const Lanes t = -log2_e * x;
  const Lanes shifted = t + rounding;
  const Lanes n = shifted - rounding;
  // ln 2 in two parts: n times the first is exact.
  const Lanes f = -x - n * 0.693359375F + n * 2.12194440e-4F;
  Lanes p = 1.3981999507e-3F * f + 8.3334519073e-3F;
  p = p * f + 4.1665795894e-2F;
  p = p * f + 1.6666665459e-1F;
  p = p * f + 0.5F;
  p = p * f * f + f + 1.0F;
  return from_bits(bits(p) + (__builtin_convertvector(n, LaneInts) << 23));
}

// visit(0), ..., visit(count - 1), with the numbers as types: what is read from tables at an index
// is then known to the compiler.
template <std::size_t count, class Visit>
void for_each_index(const Visit& visit) {
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (visit(std::integral_constant<std::size_t, i>{}), ...);
  }
  (std::make_index_sequence<count>{});
}

template <bool derivatives, bool balls>
void charges_kernel(const LanePoints& points, const DirectCharge* charges, std::uint32_t count,
                    float lambda, const BallField& ball, LaneSums& sums) {
  Lanes value{};
  Lanes derivative{};
  Lanes magnitude{};
  Lanes slope_magnitude{};
  for (std::uint32_t i = 0; i < count; ++i) {
    const DirectCharge& charge = charges[i];
    const Lanes dx = points.x - charge.x;
    const Lanes dy = points.y - charge.y;
    const Lanes dz = points.z - charge.z;
    const Lanes s = dx * dx + dy * dy + dz * dz;
    Lanes inverse = inverse_root(s);
    if constexpr (!balls)
      inverse = s > 0.0F ? inverse : all(std::numeric_limits<float>::infinity());
    const Lanes x = lambda * s * inverse;
    Lanes g = decay(x) * inverse;
    Lanes slope{};  // u'/r
    if constexpr (derivatives) slope = -(1.0F + x) * g * inverse * inverse;
    if constexpr (balls) {
      Lanes inner = all(ball.value[BallField::terms - 1]);
      Lanes inner_slope = all(ball.slope[BallField::terms - 1]);
      for (int k = BallField::terms - 2; k >= 0; --k) {
        inner = inner * s + ball.value[k];
        inner_slope = inner_slope * s + ball.slope[k];
      }
      g = s < ball.square ? inner : g;
      slope = s < ball.square ? inner_slope : slope;
    }
    const float strength = charge.strength;
    value += strength * g;
    magnitude += std::abs(strength) * g;
    if constexpr (derivatives) {
      derivative += strength * slope * (dx * points.nx + dy * points.ny + dz * points.nz);
      slope_magnitude -= std::abs(strength) * slope * s * inverse;
    }
  }
  sums.value += value;
  sums.derivative += derivative;
  sums.magnitude += magnitude;
  sums.slope_magnitude += slope_magnitude;
}

template <int degree, bool derivatives>
void cluster_kernel(const LanePoints& points, const float* coefficients, float lambda,
                    LaneSums& sums) {
  const Lanes s = points.x * points.x + points.y * points.y + points.z * points.z;
  const Lanes inverse = inverse_root(s);
  const Lanes inverse_square = inverse * inverse;
  const Lanes x = lambda * s * inverse;
  // f_(m+1) r^2 = -(2m + 1) f_m + lambda^2 f_(m-1), from f'' + 2 f'/r = lambda^2 f.
  constexpr int radial_functions = degree + 2;
  std::array<Lanes, static_cast<std::size_t>(radial_functions)> f;
  f[0] = decay(x) * inverse;
  f[1] = -(1.0F + x) * f[0] * inverse_square;
  for (std::size_t m = 1; m + 1 < f.size(); ++m)
    f[m + 1] = (lambda * lambda * f[m - 1] - static_cast<float>(2 * m + 1) * f[m]) * inverse_square;

  constexpr std::size_t terms = static_cast<std::size_t>(monomials(degree));
  std::array<Lanes, terms> power;  // the monomials, and their derivatives along the normal
  std::array<Lanes, terms> slope;
  const std::array<Lanes, 3> d{points.x, points.y, points.z};
  const std::array<Lanes, 3> n{points.nx, points.ny, points.nz};
  power[0] = all(1.0F);
  slope[0] = Lanes{};
  Lanes value = f[0] * coefficients[0];
  Lanes gradient{};                       // of the polynomials
  Lanes radial = f[1] * coefficients[0];  // f_m' = r f_(m+1)
  const auto add_degree = [&]<std::size_t m>(std::integral_constant<std::size_t, m>) {
    constexpr auto first = static_cast<std::size_t>(monomials(static_cast<int>(m) - 1));
    Lanes H{};
    Lanes dH{};
    for_each_index<(m + 1) * (m + 2) / 2>(
        [&]<std::size_t j>(std::integral_constant<std::size_t, j>) {
          constexpr std::size_t i = first + j;
          constexpr auto parent = static_cast<std::size_t>(monomial_table.parent[i]);
          constexpr auto axis = static_cast<std::size_t>(monomial_table.axis[i]);
          power[i] = power[parent] * d[axis];
          H += coefficients[i] * power[i];
          if constexpr (derivatives) {
            slope[i] = slope[parent] * d[axis] + power[parent] * n[axis];
            dH += coefficients[i] * slope[i];
          }
        });
    value += f[m] * H;
    if constexpr (derivatives) {
      gradient += f[m] * dH;
      radial += f[m + 1] * H;
    }
  };
  for_each_index<degree>([&]<std::size_t m>(std::integral_constant<std::size_t, m>) {
    add_degree(std::integral_constant<std::size_t, m + 1>{});
  });
  sums.value += value;
  if constexpr (derivatives)
    sums.derivative +=
        gradient + radial * (points.x * points.nx + points.y * points.ny + points.z * points.nz);
}

template <bool derivatives, int... degrees>
void cluster_of_degree(int degree, std::integer_sequence<int, degrees...>, const LanePoints& points,
                       const float* coefficients, float lambda, LaneSums& sums) {
  using Kernel = void (*)(const LanePoints&, const float*, float, LaneSums&);
  static constexpr Kernel kernels[] = {&cluster_kernel<degrees, derivatives>...};
  kernels[degree](points, coefficients, lambda, sums);
}

}  // namespace

BallField ball_field(double radius, double lambda) {
  // A ball of charge density 3/(4 pi radius^3), x = lambda radius: outside the field of a point
  // charge 3 (x cosh x - sinh x)/x^3, inside (4 pi u) 3/(x^2 radius) (1 - (1 + x) exp(-x)
  // i_0(lambda r)), i_0 = sinh(lambda r)/(lambda r), the solution without singularity that joins it
  // smoothly. Both divided by the factor outside, and all in powers of x, since they cancel for
  // small x:
  //   (1 - (1 + x) exp(-x)) / x^2 = sum_(n>=0) (-x)^n (n + 1)/(n + 2)!,
  //   (x cosh x - sinh x)/x^3 = sum_(n>=0) x^(2n) (2n + 2)/(2n + 3)!.
  constexpr int series_terms = 24;  // 1/24! = 2e-24
  const double x = lambda * radius;
  double gap = 0.0;
  double outside = 0.0;
  double power = 1.0;
  double factorial = 1.0;  // n!
  for (int n = 0; n < series_terms; ++n) {
    if (n > 0) factorial *= n;
    const double sign = n % 2 == 0 ? 1.0 : -1.0;
    gap += sign * power * (n + 1.0) / (factorial * (n + 1.0) * (n + 2.0));
    // (2m + 2)/(2m + 3)! x^(2m) with n = 2m.
    if (n % 2 == 0) outside += power * (n + 2.0) / (factorial * (n + 1.0) * (n + 2.0) * (n + 3.0));
    power *= x;
  }
  BallField ball;
  ball.square = static_cast<float>(radius * radius);
  const double decayed = (1.0 + x) * std::exp(-x);
  // i_0 - 1 = sum_(i>=1) (lambda r)^(2i)/(2i + 1)!; divided by x^2 the first is (r/radius)^2/6.
  double coefficient = 1.0 / (outside * radius);  // of r^(2i), before the factor -decayed/(2i+1)!
  ball.value[0] = static_cast<float>(coefficient * gap);
  double odd_factorial = 1.0;
  for (int i = 1; i <= BallField::terms; ++i) {
    odd_factorial *= (2.0 * i) * (2.0 * i + 1.0);
    coefficient *= i == 1 ? 1.0 / (radius * radius) : lambda * lambda;
    const double term = -decayed * coefficient / odd_factorial;
    if (i < BallField::terms) ball.value[i] = static_cast<float>(term);
    ball.slope[i - 1] = static_cast<float>(2.0 * i * term);
  }
  return ball;
}

void add_charges(const LanePoints& points, const DirectCharge* charges, std::uint32_t count,
                 float lambda, const BallField& ball, bool derivatives, LaneSums& sums) {
  const bool balls = ball.square > 0.0F;
  if (balls)
    derivatives ? charges_kernel<true, true>(points, charges, count, lambda, ball, sums)
                : charges_kernel<false, true>(points, charges, count, lambda, ball, sums);
  else
    derivatives ? charges_kernel<true, false>(points, charges, count, lambda, ball, sums)
                : charges_kernel<false, false>(points, charges, count, lambda, ball, sums);
}

void add_cluster(const LanePoints& points, const float* coefficients, int degree, float lambda,
                 bool derivatives, LaneSums& sums) {
  constexpr auto degrees = std::make_integer_sequence<int, cluster_degree + 1>{};
  if (derivatives)
    cluster_of_degree<true>(degree, degrees, points, coefficients, lambda, sums);
  else
    cluster_of_degree<false>(degree, degrees, points, coefficients, lambda, sums);
}

}  // namespace knotlight
