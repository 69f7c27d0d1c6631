#include "chart/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knotlight {
namespace {

bool usable(const Measurement& m, Quantity quantity) {
  return m.trusted() && std::isfinite(error_of(m, quantity)) && seconds_of(m, quantity) > 0.0;
}

}  // namespace

double error_of(const Measurement& m, Quantity quantity) {
  return quantity == Quantity::field ? m.field.error : m.picture.error;
}

double noise_of(const Measurement& m, Quantity quantity) {
  return quantity == Quantity::field ? m.field.noise : m.picture.noise;
}

double seconds_of(const Measurement& m, Quantity quantity) {
  return quantity == Quantity::field ? m.field_seconds : m.picture_seconds;
}

bool is_rival(const Measurement& m) {
  return m.line == dipole_line || m.line == better_dipole_line || m.line == path_tracing_line ||
         m.line == finite_elements_line;
}

std::vector<Measurement> pareto_front(const std::vector<Measurement>& all, Quantity quantity) {
  std::vector<Measurement> sorted;
  for (const Measurement& m : all)
    if (usable(m, quantity)) sorted.push_back(m);
  std::stable_sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
    return std::pair(seconds_of(a, quantity), error_of(a, quantity)) <
           std::pair(seconds_of(b, quantity), error_of(b, quantity));
  });
  std::vector<Measurement> front;
  for (const Measurement& m : sorted)
    if (front.empty() || error_of(m, quantity) < error_of(front.back(), quantity))
      front.push_back(m);
  return front;
}

std::optional<Measurement> cheapest(const std::vector<Measurement>& all, Quantity quantity,
                                    double error) {
  std::vector<Measurement> ours;
  for (const Measurement& m : all)
    if (!is_rival(m)) ours.push_back(m);
  for (const Measurement& m : pareto_front(ours, quantity))
    if (error_of(m, quantity) <= error) return m;
  return std::nullopt;
}

std::optional<LineSeconds> seconds_for(const std::vector<Measurement>& all, const std::string& line,
                                       Quantity quantity, double error) {
  std::vector<Measurement> own;
  for (const Measurement& m : all)
    if (m.line == line) own.push_back(m);
  const std::vector<Measurement> front = pareto_front(own, quantity);
  for (const Measurement& m : front)
    if (error_of(m, quantity) <= error) return LineSeconds{seconds_of(m, quantity), false};
  if (line != path_tracing_line || front.empty()) return std::nullopt;
  const double ratio = error_of(front.back(), quantity) / error;
  return LineSeconds{seconds_of(front.back(), quantity) * ratio * ratio, true};
}

double least_error(const std::vector<Measurement>& all, const std::string& line,
                   Quantity quantity) {
  double least = std::numeric_limits<double>::infinity();
  for (const Measurement& m : all)
    if (m.line == line && usable(m, quantity)) least = std::min(least, error_of(m, quantity));
  return least;
}

std::vector<ToleranceCheck> check_tolerance(const std::vector<Measurement>& all,
                                            Quantity quantity) {
  std::vector<ToleranceCheck> checks;
  for (const Measurement& chosen : all) {
    if (chosen.line != default_line || !usable(chosen, quantity)) continue;
    const Measurement best = *cheapest(all, quantity, error_of(chosen, quantity));
    checks.push_back({chosen, best, seconds_of(chosen, quantity) / seconds_of(best, quantity)});
  }
  return checks;
}

}  // namespace knotlight
