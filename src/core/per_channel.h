// Scenes of one channel keep its value in all three places of a Spectrum.
#pragma once

#include "core/vec3.h"

namespace knotlight {

// value(c) for each channel c of a scene with so many (1 or 3), a single one three times.
template <class Value>
Spectrum per_channel(int channels, const Value& value) {
  if (channels == 1) return Spectrum::Constant(value(0));
  return {value(0), value(1), value(2)};
}

}  // namespace knotlight
