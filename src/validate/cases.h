// The cases that `validate` runs, and the kinds of case they are made of.
#pragma once

#include <functional>

#include "core/medium.h"
#include "reference/exact_transport.h"
#include "validate/validate.h"

namespace knotlight {

// How a case is run: its random numbers, and on one thread, since cases run side by side.
struct CaseRun {
  std::uint64_t seed = 1;
};

struct ValidationCase {
  std::string name;
  bool quick;  // part of the quick selection
  std::function<void(const CaseRun&, ValidatedCase&)> run;
};

// All of them, in the order of the report: one line each.
const std::vector<ValidationCase>& validation_cases();

// What a P1 case is solved with.
struct CaseSolver {
  double cell = 0.5;  // cells of the grid, transport mean free paths
  std::size_t photons = 500'000;
  double allowed = 0.005;  // error of U_d and fluxes
  Boundary boundary = Boundary::marshak;
  // Of a slab's lit face and a ball's lit pole, where U_d may be a small difference of large parts;
  // 0: as the rest.
  double allowed_lit = 0.0;

  double allowed_where_lit() const { return allowed_lit > 0.0 ? allowed_lit : allowed; }
};

// sigma_t = `extinction` (1/length).
Medium medium_of(double extinction, double albedo, double g, double ior);

// Each fills in rows and curves. Slabs are wide boxes of thickness 1, balls have radius 1.
void run_slab(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
              ValidatedCase& result);
void run_diffuse_slab(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                      ValidatedCase& result);
void run_ball_under_beam(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                         ValidatedCase& result);
void run_lamp_in_ball(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                      ValidatedCase& result);
void run_glowing_ball(const Medium& medium, const CaseSolver& solver, const CaseRun& run,
                      ValidatedCase& result);
// Density estimates and right-hand sides at points, before any equation is solved.
void run_source_terms(const Medium& medium, std::size_t photons, const CaseRun& run,
                      ValidatedCase& result);
// Photons of all orders against the transfer equation.
void run_exact_slab(const ExactSlab& slab, std::size_t photons, const CaseRun& run,
                    ValidatedCase& result);
// P1's closed form against the transfer equation: the error of the model, which nobody can mend by
// computing better.
void run_model_error(const CaseRun& run, ValidatedCase& result);

}  // namespace knotlight
