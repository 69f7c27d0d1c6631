// Random scenes whose answer is known: what error estimates are judged by.
#pragma once

#include <cstdint>
#include <string>

#include "cases.h"

namespace knotlight {

struct RandomCase {
  BarsCase scene;           // its bar is the tolerance that it asks for
  std::string description;  // what was drawn, in words
  std::uint64_t seed;       // for the random numbers of the run
};

// Number `index` under a seed. Three of four are balls of 2 to 60 transport mean free paths, with
// any absorption, asymmetry and boundary, under 1 to 3 beams, a third of them glowing too: exact
// solutions turned and added. The fourth is one of the cases with sharp edges, facets and hollows,
// in turn. Tolerances: 0.005 to 0.04.
RandomCase random_case(std::uint64_t seed, std::size_t index);

}  // namespace knotlight
