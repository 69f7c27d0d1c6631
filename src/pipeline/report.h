// What a run has found out about its own numbers. Everything here goes into the JSON summary; what
// fails a check makes the program end with exit code 3.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "photon/energy_audit.h"
#include "pipeline/validity.h"

namespace knotlight {

// One object in one colour channel. Errors are relative to the size of U_d on the surface: its rms
// with the grid method, its largest value with bkm_thesis, whose bound is one on the largest error.
struct ChannelReport {
  double lambda = 0.0;  // 1/length
  double k = 0.0;       // length

  std::string method;  // that found the solution, as solver.method has it

  std::size_t photons = 0;     // recorded in the object
  double photon_power = 0.0;   // of the light that interacts first there, W
  double entered_power = 0.0;  // by irradiance samples; 0 with the photon map, W
  // What else the method has to tell, by name (docs/json.md).
  std::vector<std::pair<std::string, double>> figures;

  double numerical_error = 0.0;   // of solving the equations given the photons; may be infinite
  double noise = 0.0;             // rms on the surface, from two halves of the photons
  double error_estimate = 0.0;    // numerical_error + noise
  double energy_imbalance = 0.0;  // (leaving + absorbed - scattered in - emitted) / (in + emitted)
  double energy_imbalance_standard_error = 0.0;  // of the volume integral
  double power_in = 0.0;                         // scattered in + emitted, W
  double power_leaving = 0.0;                    // W
  double power_absorbed = 0.0;                   // of the diffuse light, W
};

struct ObjectReport {
  std::string name;
  std::string source;                   // which source model, and why, in words
  std::string method;                   // what was solved, and why, in words
  std::vector<Validity> validity;       // per channel
  std::vector<ChannelReport> channels;  // per channel; empty before a solve
  std::vector<EnergyAudit> audit;       // per channel; empty if not asked for
};

struct Report {
  std::size_t photons_emitted = 0;    // per channel; none with the other source models
  std::vector<ObjectReport> objects;  // the translucent ones, in scene order
  std::vector<std::string> failures;  // checks that failed, one sentence each; empty = trusted
};

}  // namespace knotlight
