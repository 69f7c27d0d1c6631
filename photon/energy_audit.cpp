#include "photon/energy_audit.h"

#include <cmath>
#include <limits>

namespace knotlight {
namespace {

// Standard error of the sum over batches whose deviations from expectation are given.
double standard_error(const std::vector<double>& deviations) {
  if (deviations.size() < 2) return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  for (const double d : deviations) squares += d * d;
  const auto n = static_cast<double>(deviations.size());
  return std::sqrt(squares * n / (n - 1.0));
}

}  // namespace

PowerTally& PowerTally::operator+=(const PowerTally& other) {
  incident += other.incident;
  reflected += other.reflected;
  absorbed += other.absorbed;
  escaped += other.escaped;
  escaped_unscattered += other.escaped_unscattered;
  unfollowed += other.unfollowed;
  lost += other.lost;
  interactions += other.interactions;
  photons += other.photons;
  return *this;
}

EnergyAudit energy_audit(const std::vector<PowerTally>& batches,
                         const std::vector<std::size_t>& sizes) {
  EnergyAudit audit;
  std::size_t emitted = 0;
  for (const PowerTally& batch : batches) audit += batch;
  for (const std::size_t size : sizes) emitted += size;

  std::vector<double> deviations(batches.size());
  for (std::size_t i = 0; i < batches.size(); ++i) {
    const double share = static_cast<double>(sizes[i]) / static_cast<double>(emitted);
    deviations[i] = batches[i].incident - share * audit.incident;
  }
  audit.standard_error_incident = standard_error(deviations);
  if (audit.incident == 0.0) return audit;  // nothing arrived: the other sums are exactly 0

  const auto ratio_error = [&](double PowerTally::*quantity) {
    const double ratio = audit.*quantity / audit.incident;
    for (std::size_t i = 0; i < batches.size(); ++i)
      deviations[i] = batches[i].*quantity - ratio * batches[i].incident;
    return standard_error(deviations);
  };
  audit.standard_error_reflected = ratio_error(&PowerTally::reflected);
  audit.standard_error_absorbed = ratio_error(&PowerTally::absorbed);
  audit.standard_error_escaped = ratio_error(&PowerTally::escaped);
  audit.standard_error_interactions = ratio_error(&PowerTally::interactions);
  return audit;
}

}  // namespace knotlight
