// Photons of all orders against exact transport, at a relative standard error of 1e-3, as Markdown
// tables. Not a timing; it lies here because it takes minutes (an hour with E = 0).
//
//   transport_bench slabs [E] > slabs.md
//   transport_bench shapes > shapes.md
//   transport_bench slabs|shapes --quick     few photons: that it runs, not what is true
//
// E (of the incident power; 0): no standard error of T need be below it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "../photon/photon_scenes.h"
#include "scene/mesh_reader.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::trace;
using Orders = TracerOptions::Orders;

constexpr double wanted = 1e-3;  // relative standard error
constexpr double quick = 1e-3;   // of the photons

// Normal incidence, specular reflection and unscattered transmission included. [vdH80], [G55]
// (the second) or adding-doubling; `half_digit` is half a unit of the last digit given.
struct SlabCase {
  double ior, albedo, b, g, R, R_half_digit, T, T_half_digit;
};
constexpr SlabCase slab_cases[] = {
    {1.0, 0.9, 2, 0.75, 0.09739, 5e-6, 0.66096, 5e-6},
    {1.5, 0.9, 40, 0, 0.2600, 5e-5, 0.0, 5e-6},  // a half-space but for 1e-9
    {1.0, 0.9, 2, 0, 0.36165, 5e-6, 0.3565, 5e-5},
    {1.0, 0.9, 10, 0, 0.41493, 5e-6, 0.00561, 5e-6},
    {1.0, 0.99, 2, 0, 0.49749, 5e-6, 0.4657, 5e-5},
    {1.0, 0.99, 10, 0, 0.74093, 5e-6, 0.08476, 5e-6},
    {1.0, 0.99, 20, 0, 0.75235, 5e-6, 0.01482, 5e-6},
    {1.0, 0.999, 10, 0, 0.83888, 5e-6, 0.13825, 5e-6},
    {1.0, 0.999, 20, 0, 0.89331, 5e-6, 0.06311, 5e-6},
    {1.4, 0.9, 10, 0, 0.2784, 5e-5, 0.0045, 5e-5},
    {1.4, 0.99, 10, 0, 0.6219, 5e-5, 0.1026, 5e-5},
    {1.4, 0.99, 20, 0, 0.6311, 5e-5, 0.0181, 5e-5},
    {1.4, 0.999, 20, 0, 0.8323, 5e-5, 0.0937, 5e-5},
    {1.0, 0.99, 50, 0.8, 0.52172, 5e-6, 0.01633, 5e-6},
    {1.4, 0.99, 50, 0.8, 0.3858, 5e-5, 0.0151, 5e-5},
};

// Arrivals for which the standard error of a share p is `wanted` p, or the largest of the limits
// given if that is worse.
double arrivals_for(double p, double half_digit, double least_error) {
  const double error = std::max({wanted * p, half_digit, least_error});
  return p * (1.0 - p) / (error * error);
}

// How many standard errors the share lies from the value given, beyond what its digits leave open.
std::string judged(double share, double n, double exact, double half_digit) {
  const double error = std::sqrt(share * (1.0 - share) / n);
  const double beyond = std::max(0.0, std::abs(share - exact) - half_digit);
  return fmt::format("{:.5f} | {} | {:.1e} | {:.1f}", share, exact, error / share,
                     beyond == 0.0 ? 0.0 : beyond / error);
}

void slab_rows(double least_error, double share) {
  fmt::print(
      "| ior | albedo | b | g | R | exact | rel. std. error | std. errors off | T | exact | rel. "
      "std. error | std. errors off | photons, M | interactions, M |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::uint64_t seed = 0;  // one per case: under a common one the deviations would be alike
  for (const SlabCase& c : slab_cases) {
    const double n = share * std::max(arrivals_for(c.R, c.R_half_digit, 0.0),
                                      arrivals_for(c.T, c.T_half_digit, least_error));
    // The share of the emitted photons that the mask lets through.
    const double through = testing_scenes::slab_beam_area / (pi * (2.0 * 200.0 * 200.0 + 0.25));
    const TraceResult r =
        trace(testing_scenes::slab_scene(testing_scenes::slab_medium(c.b, c.albedo, c.g, c.ior)),
              Orders::all, static_cast<std::size_t>(1.01 * n / through), false, 0, ++seed);
    const EnergyAudit& slab = r.audit[0];
    const auto arrived = static_cast<double>(slab.photons);
    const double T = r.audit[1].incident / slab.incident;
    const double R = (slab.reflected + slab.escaped) / slab.incident - T;
    fmt::print("| {} | {} | {} | {} | {} | ", c.ior, c.albedo, c.b, c.g,
               judged(R, arrived, c.R, c.R_half_digit));
    fmt::print("{} | {:.1f} | {:.0f} |\n",
               T > 0.0 ? judged(T, arrived, c.T, c.T_half_digit) : "0 | 0 | | ", 1e-6 * arrived,
               1e-6 * arrived * slab.interactions / slab.incident);
    std::fflush(stdout);
  }
}

struct Body {
  std::string name;
  Shape shape;
};

std::vector<Body> bodies() {
  std::vector<std::string> warnings;
  return {
      {"sphere", Sphere{}},
      {"torus, 1600 triangles", testing_scenes::torus_mesh(40, 20)},
      {"knot.ply, 22876 triangles",
       make_solid(read_mesh(std::string(KNOTLIGHT_ROOT) + "/scenes/meshes/knot.ply"), warnings)}};
}

// Uniform light, no absorption. Mean path from the lengths in one cell around the body; U and F in
// the cells of a 12 x 12 x 12 grid of which 1e-2 or more is inside.
void shape_rows(std::size_t photons) {
  fmt::print(
      "| body | sigma_s 4V/S | g | ior | mean path / (n^2 4V/S) | std. error | cells | rms of (U - "
      "n^2) / std. error: collisions | track lengths | rms of F / std. error: collisions | track "
      "lengths | median std. error of U: collisions | track lengths |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Body& body : bodies()) {
    const double width = 4.0 * volume(body.shape) / surface_area(body.shape);
    for (const auto& [depth, g, ior] : {std::array{0.3, 0.0, 1.0}, std::array{8.0, 0.0, 1.0},
                                        std::array{8.0, 0.8, 1.0}, std::array{8.0, 0.0, 1.4}}) {
      const Medium medium{0.0, depth / width, g, ior, 0.0};
      const Scene scene = testing_scenes::scene_of(
          {testing_scenes::sky(1.0)}, {testing_scenes::translucent(body.shape, medium)});
      Bounds b = bounds(body.shape);
      b.hi += 1e-9 * (b.hi - b.lo);  // cells are half-open
      std::vector<FluxTally> tallies;
      tallies.emplace_back(FluxGrid{b.lo, b.hi, {1, 1, 1}}, 0, body.shape, medium);
      tallies.emplace_back(FluxGrid{b.lo, b.hi, {12, 12, 12}}, 0, body.shape, medium);
      const TraceResult r = trace(scene, Orders::all, photons, false, 2, 1, tallies);
      const Flux whole = tallies[0].flux(0, FluxOrder::all, FluxEstimator::track_lengths);
      const double n2 = ior * ior;
      const double path = 4.0 * pi * whole.U * tallies[0].volume(0) / r.audit[0].incident;
      fmt::print("| {} | {} | {} | {} | {:.5f} | {:.1e} |", body.name, depth, g, ior,
                 path / (n2 * width),
                 std::hypot(whole.U_error / whole.U,
                            r.audit[0].standard_error_incident / r.audit[0].incident));
      double cells = 0.0;
      std::array<double, 2> U{}, F{}, median{};
      for (const int e : {0, 1}) {
        cells = 0.0;
        std::vector<double> errors;
        for (std::size_t c = 0; c < tallies[1].grid().cells(); ++c) {
          if (tallies[1].volume(c) < 1e-2 * tallies[1].grid().cell_size().prod()) continue;
          const Flux f = tallies[1].flux(c, FluxOrder::all, static_cast<FluxEstimator>(e));
          cells += 1.0;
          errors.push_back(f.U_error / n2);
          U[e] += std::pow((f.U - n2) / f.U_error, 2);
          F[e] += (f.F.array() / f.F_error.array()).square().mean();
        }
        std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
        median[e] = errors[errors.size() / 2];
      }
      fmt::print(" {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1e} | {:.1e} |\n", cells,
                 std::sqrt(U[0] / cells), std::sqrt(U[1] / cells), std::sqrt(F[0] / cells),
                 std::sqrt(F[1] / cells), median[0], median[1]);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  const std::string what = argc >= 2 ? argv[1] : "";
  const bool few = argc == 3 && std::string(argv[2]) == "--quick";
  const double share = few ? knotlight::quick : 1.0;
  if (what == "slabs" && argc <= 3) {
    knotlight::slab_rows(argc == 3 && !few ? std::atof(argv[2]) : 0.0, share);
  } else if (what == "shapes" && (argc == 2 || few)) {
    knotlight::shape_rows(static_cast<std::size_t>(share * 3e6));
  } else {
    fmt::print(stderr, "usage: transport_bench slabs [E] | shapes | slabs|shapes --quick\n");
    return 2;
  }
  return 0;
}
