// The volume source that a model puts into an object, on a slice through it.
#pragma once

#include "compare/places.h"
#include "pipeline/incident_light.h"
#include "report/false_colour.h"

namespace knotlight {

// Source density -f, W/(length^4 sr), in the cells of the slice, channel 0, from the light that the
// model starts from; light that the object emits is left out. NaN outside the object. Photons count
// with 3 sigma_s (sigma_tr + g sigma_t) / (4 pi sigma_t) times their power, points of
// irradiance_sampling with their strength. What boundary_flux and irradiance_thesis put on the
// surface or at knots has no density: of them only light that comes back to the object shows.
ValueMap source_slice(const IncidentLight& light, const PreparedScene& prepared,
                      std::uint32_t object, const Slice& slice);

// Decades below the largest value: log10(value / largest); zero becomes `lowest`. NaN stays.
ValueMap decades_below(const ValueMap& map, double largest, double lowest);

}  // namespace knotlight
