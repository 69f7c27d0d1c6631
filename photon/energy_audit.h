// Where the power that arrived at an object went. For every photon, and so exactly for the sums,
//   incident = reflected + absorbed + escaped + unfollowed + lost
// (docs/theory.md, "Energy audit").
#pragma once

#include <cstddef>
#include <vector>

namespace knotlight {

// All in W. An arrival is a photon that meets the object's surface from outside; light that left a
// concave object and meets it again arrives again. A light placed inside a translucent object
// arrives without being reflected; so does light that a diffuse object inside it has reflected. Of
// a diffuse object: what the lights, or other diffuse objects, throw on it straight is counted as
// far as it was aimed at the translucent objects, and the reflected part of that as `unfollowed`.
struct PowerTally {
  double incident = 0.0;
  double reflected = 0.0;  // thrown back at arrival (Fresnel, or diffusely)
  double absorbed = 0.0;   // in the medium
  double escaped = 0.0;    // left the medium again, outwards or into an opaque object in it
  double escaped_unscattered = 0.0;  // the part of `escaped` that never interacted
  double unfollowed = 0.0;  // ended on purpose, as at its first interaction (Orders::first)
  double lost = 0.0;        // dropped because of rounding at edges; must be tiny
  // Sum over all interactions = sigma_t * integral of the fluence 4 pi U over the object.
  double interactions = 0.0;
  std::size_t photons = 0;  // that arrived

  PowerTally& operator+=(const PowerTally& other);
};

// Sums over all batches, with standard errors from the spread over batches. Those of `absorbed`,
// `escaped`, `reflected` and `interactions` are for the incident power as it came out (ratio
// estimator): divided by `incident` they are the standard errors of the fractions below. Infinite
// if there are fewer than two batches.
struct EnergyAudit : PowerTally {
  double standard_error_incident = 0.0;
  double standard_error_reflected = 0.0;
  double standard_error_absorbed = 0.0;
  double standard_error_escaped = 0.0;
  double standard_error_interactions = 0.0;

  // Of the incident power; not a number if nothing arrived.
  double reflected_fraction() const { return reflected / incident; }
  double absorbed_fraction() const { return absorbed / incident; }
  double escaped_fraction() const { return escaped / incident; }
};

// batches: tallies of disjoint sets of photons, sizes[i] photons emitted for batch i.
EnergyAudit energy_audit(const std::vector<PowerTally>& batches,
                         const std::vector<std::size_t>& sizes);

}  // namespace knotlight
