// What each second buys: the settings that nothing measured beats, and which to use.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart/measurement.h"

namespace knotlight {

// The field on the surface, or the finished picture: what errors and seconds are of.
enum class Quantity { field, picture };

double error_of(const Measurement& m, Quantity quantity);
double noise_of(const Measurement& m, Quantity quantity);
double seconds_of(const Measurement& m, Quantity quantity);  // CPU

// Not one of our solver's settings.
bool is_rival(const Measurement& m);

// Trusted measurements that no other trusted one beats in both error and seconds, by rising
// seconds.
std::vector<Measurement> pareto_front(const std::vector<Measurement>& all, Quantity quantity);

// Our cheapest trusted setting with at most this error.
std::optional<Measurement> cheapest(const std::vector<Measurement>& all, Quantity quantity,
                                    double error);

// Seconds a line needs for this error: of its cheapest trusted measurement that has it. Path
// tracing, whose error falls as one over the root of its time, may be asked for errors it was not
// run for; then `extrapolated`.
struct LineSeconds {
  double seconds;
  bool extrapolated;
};
std::optional<LineSeconds> seconds_for(const std::vector<Measurement>& all, const std::string& line,
                                       Quantity quantity, double error);

// Of the line's trusted measurements; infinite if there are none.
double least_error(const std::vector<Measurement>& all, const std::string& line, Quantity quantity);

// A setting that `tolerance` chose, beside the cheapest that has no larger error.
struct ToleranceCheck {
  Measurement chosen, best;
  double ratio;  // of their seconds
};
std::vector<ToleranceCheck> check_tolerance(const std::vector<Measurement>& all, Quantity quantity);

}  // namespace knotlight
