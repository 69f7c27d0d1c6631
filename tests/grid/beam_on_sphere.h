// A beam on a sphere, with photons placed by quadrature: a known field without noise.
#pragma once

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "core/medium.h"
#include "grid/grid_cases.h"

namespace knotlight::grid_cases {

// Solver residual 1e-9; the sums that the balance compares lose a digit.
inline constexpr double energy_tolerance = 1e-8;

// Beam along -z on the unit sphere, index-matched, isotropic scattering.
struct BeamCase {
  double sigma_t, albedo;
  std::vector<std::pair<double, double>> surface;  // z, U_d: the P1 equations by Legendre series
};
inline const std::vector<BeamCase>& beam_cases() {
  static const std::vector<BeamCase> cases{
      {5.0,
       0.99,
       {{-1.0, .003744257},
        {-0.5, .008330399},
        {0.0, .03063731},
        {0.5, .06369354},
        {1.0, .08669092}}},
      {20.0, 0.9, {{0.0, .00571846}, {0.5, .04295966}, {1.0, .06688382}}},
      {20.0,
       0.999,
       {{-1.0, .0006950245},
        {-0.5, .001456252},
        {0.0, .01305018},
        {0.25, .04613824},
        {0.5, .07692854},
        {1.0, .1307355}}}};
  return cases;
}

inline Medium medium_of(const BeamCase& beam) {
  Medium medium;
  medium.sigma_s = beam.sigma_t * beam.albedo;
  medium.sigma_a = beam.sigma_t - medium.sigma_s;
  return medium;
}

inline GridLoad beam_load(const BeamCase& beam, const GridGeometry& g) {
  const Medium medium = medium_of(beam);
  GridLoad load(g);
  constexpr int rays = 160;  // across the sphere
  const double spacing = 2.0 / rays;
  for (int i = 0; i < rays; ++i)
    for (int j = 0; j < rays; ++j) {
      const double x = -1.0 + (i + 0.5) * spacing, y = -1.0 + (j + 0.5) * spacing;
      const double top = std::sqrt(1.0 - x * x - y * y);
      if (!(top > 0.0)) continue;
      // Equal steps in depth, a sixth of a mean free path, the power of each at its mean depth.
      const int steps = 2 + static_cast<int>(12.0 * top * beam.sigma_t);
      const double step = 2.0 * top / steps;
      for (int k = 0; k < steps; ++k) {
        const double a = k * step, b = a + step;
        const double fa = std::exp(-beam.sigma_t * a), fb = std::exp(-beam.sigma_t * b);
        if (fa < 1e-9) break;
        const double depth = 1.0 / beam.sigma_t + (a * fa - b * fb) / (fa - fb);
        const double power = (fa - fb) * spacing * spacing;
        load.add_source(Vec3(x, y, top - depth), 3.0 * medium.sigma_s * medium.sigma_tr() * power /
                                                     (4.0 * pi * beam.sigma_t));
      }
    }
  return load;
}

inline GridSolver beam_solver(const BeamCase& beam, const std::shared_ptr<const GridGeometry>& g) {
  const DiffusionCoefficients c = diffusion_coefficients(medium_of(beam), Boundary::marshak);
  return {g, c.lambda, c.k};
}

inline GridSolution beam_on_sphere(const BeamCase& beam,
                                   const std::shared_ptr<const GridGeometry>& g) {
  const GridSolution s = beam_solver(beam, g).solve(beam_load(beam, *g));
  EXPECT_LT(std::abs(s.imbalance), energy_tolerance);
  return s;
}

// The same by cells of twice the size, from the fine grid's second level.
inline GridSolution coarse_beam_on_sphere(const BeamCase& beam,
                                          const std::shared_ptr<const GridGeometry>& g) {
  const GridSolution s = beam_solver(beam, g).solve_coarse(beam_load(beam, *g).values());
  EXPECT_LT(std::abs(s.imbalance), energy_tolerance);
  return s;
}

// Relative L2 error over the points given, each as a circle of 24 points of the surface.
inline double beam_error(const BeamCase& beam, const GridField& field) {
  double error = 0.0, size = 0.0;
  for (const auto& [z, u] : beam.surface)
    for (int i = 0; i < 24; ++i) {
      const double phi = 2.0 * pi * (i + 0.3) / 24.0, r = std::sqrt(1.0 - z * z);
      const Vec3 x(r * std::cos(phi), r * std::sin(phi), z);
      const double d = field.value(x, x) - u;
      error += d * d;
      size += u * u;
    }
  return std::sqrt(error / size);
}

}  // namespace knotlight::grid_cases
