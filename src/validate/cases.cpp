#include "validate/cases.h"

namespace knotlight {

Medium medium_of(double extinction, double albedo, double g, double ior) {
  return {extinction * (1.0 - albedo), extinction * albedo, g, ior, 0.0};
}

namespace {

constexpr bool quick = true, full = false;

using Run = std::function<void(const CaseRun&, ValidatedCase&)>;
using Kind = void (*)(const Medium&, const CaseSolver&, const CaseRun&, ValidatedCase&);

Run p1(Kind kind, const Medium& medium, const CaseSolver& solver) {
  return [=](const CaseRun& run, ValidatedCase& result) { kind(medium, solver, run, result); };
}

constexpr std::size_t slab_rays = 4'000'000;

struct Slab {
  double b, albedo, g, ior;
  std::size_t rays = slab_rays;
};

// At the lit face U_d of forward scattering is what is left of parts ten times as large, and so is
// boundary_flux's R: there the same error counts for more.
struct Allowed {
  double error = 0.005;
  double at_lit_face = 0.0;  // 0: the same
};

Run slab_of(Kind kind, const Slab& slab, int cells, const Allowed& allowed, Boundary boundary) {
  const Medium medium = medium_of(slab.b, slab.albedo, slab.g, slab.ior);
  return p1(kind, medium,
            {medium.sigma_tr() / cells, slab.rays, allowed.error, boundary, allowed.at_lit_face});
}

Run slab(const Slab& medium, int cells, const Allowed& allowed = {},
         Boundary boundary = Boundary::marshak) {
  return slab_of(run_slab, medium, cells, allowed, boundary);
}

Run diffuse_slab(const Slab& medium, int cells, const Allowed& allowed) {
  return slab_of(run_diffuse_slab, medium, cells, allowed, Boundary::marshak);
}

Medium glowing(const Medium& medium) {
  Medium m = medium;
  m.emission = 1.0;
  return m;
}

Run source(const Medium& medium, std::size_t photons) {
  return [=](const CaseRun& run, ValidatedCase& result) {
    run_source_terms(medium, photons, run, result);
  };
}

Run exact(const ExactSlab& slab, std::size_t photons) {
  return [=](const CaseRun& run, ValidatedCase& result) {
    run_exact_slab(slab, photons, run, result);
  };
}

}  // namespace

const std::vector<ValidationCase>& validation_cases() {
  constexpr std::size_t M = 1'000'000;
  constexpr Boundary milne = Boundary::milne;
  static const std::vector<ValidationCase> cases{
      // clang-format off
      // Slabs under a beam: (b, albedo, g, n), cells across the thickness, which then has nodes on
      // both faces; allowed.
      {"slab b 2, albedo 0.9",                  full, slab({2, 0.9, 0, 1}, 20)},
      {"slab b 2, albedo 0.999, n 1.4",         full, slab({2, 0.999, 0, 1.4}, 14)},
      {"slab b 10, albedo 0.9",                 full, slab({10, 0.9, 0, 1}, 56)},
      {"slab b 10, albedo 0.99",                full, slab({10, 0.99, 0, 1}, 32)},
      {"slab b 10, albedo 0.99, milne",         full, slab({10, 0.99, 0, 1}, 32, {}, milne)},
      {"slab b 10, albedo 0.99, n 1.4",         full, slab({10, 0.99, 0, 1.4}, 28)},
      {"slab b 10, albedo 0.99, g 0.8, n 1.4",  full, slab({10, 0.99, 0.8, 1.4}, 20)},
      {"slab b 10, albedo 0.9, g 0.8",          full, slab({10, 0.9, 0.8, 1}, 64)},
      {"slab b 20, albedo 0.99",                full, slab({20, 0.99, 0, 1}, 44)},
      {"slab b 20, albedo 0.999",               full, slab({20, 0.999, 0, 1}, 36)},
      {"slab b 20, albedo 0.9, g 0.8, n 1.4",   full, slab({20, 0.9, 0.8, 1.4}, 84)},
      {"slab b 20, albedo 0.999, g 0.8",        full, slab({20, 0.999, 0.8, 1}, 36)},
      {"slab b 2, albedo 0.99, g 0.8",          full, slab({2, 0.99, 0.8, 1, 3 * slab_rays}, 20)},
      {"quick slab, b 6, g 0.8, n 1.4",         quick, slab({6, 0.9, 0.8, 1.4}, 14, {0.02, 0.04})},
      // The same light taken as diffuse at once (boundary_flux).
      {"boundary flux, slab b 10",              full, diffuse_slab({10, 0.99, 0, 1}, 20, {})},
      {"boundary flux, slab b 10, n 1.4",       full, diffuse_slab({10, 0.99, 0, 1.4}, 20, {})},
      // Balls of radius 1: (sigma_t, albedo, g, n), cells in transport mean free paths, allowed.
      {"ball under a beam, 5",                  full, p1(run_ball_under_beam, medium_of(5, 0.99, 0, 1), {0.15, M / 2})},
      {"ball under a beam, 5, g 0.8",           full, p1(run_ball_under_beam, medium_of(5, 0.99, 0.8, 1), {0.03, M / 2, 0.005, Boundary::marshak, 0.02})},
      {"ball under a beam, 10",                 full, p1(run_ball_under_beam, medium_of(10, 0.95, 0, 1), {0.2, M / 2, 0.0075})},
      {"ball under a beam, 20",                 full, p1(run_ball_under_beam, medium_of(20, 0.999, 0, 1), {0.35, M / 2, 0.01})},
      {"lamp in a ball",                        full, p1(run_lamp_in_ball, medium_of(10, 0.99, 0, 1), {0.3, M / 2})},
      {"lamp in a ball, g 0.8, n 1.4",          full, p1(run_lamp_in_ball, medium_of(20, 0.99, 0.8, 1.4), {0.15, M / 2})},
      {"glowing ball",                          full, p1(run_glowing_ball, glowing(medium_of(10, 0.9, 0, 1)), {0.3, M / 2})},
      {"quick glowing ball, n 1.4",             quick, p1(run_glowing_ball, glowing(medium_of(5, 0.9, 0.5, 1.4)), {0.2, M / 10, 0.01})},
      {"quick lamp in a ball, g 0.5",           quick, p1(run_lamp_in_ball, medium_of(8, 0.9, 0.5, 1), {0.3, M / 10, 0.01})},
      // What the photon map estimates at points.
      {"quick source terms",                    quick, source(medium_of(5, 0.95, 0.8, 1), M)},
      // Transport by photons of all orders.
      {"photons, b 2, albedo 0.9, g 0.75",      full, exact(classic_slabs()[0], 4 * M)},
      {"photons, half-space, n 1.5",            full, exact(classic_slabs()[1], 4 * M)},
      {"quick photons",                         quick, exact(classic_slabs()[0], M / 5)},
      {"diffusion against transport",           full, run_model_error},
      // clang-format on
  };
  return cases;
}

}  // namespace knotlight
