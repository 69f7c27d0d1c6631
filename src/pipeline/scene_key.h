// What a solution depends on, as fingerprints that can be kept and compared.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace knotlight {

// One part of a scene: its name for people, and its fingerprint.
struct KeyPart {
  std::string name;
  std::uint64_t value;
};

// Everything that a solution depends on, or that is said about it: seed, lights, shapes, materials
// and settings of the solver. Not in it: the camera and the exitance, which only look at the
// solution.
std::vector<KeyPart> solution_key(const Scene& scene, std::uint64_t seed);

// The name of the first part that is not the same in both, or is not in both; empty if there is
// none.
std::string first_difference(const std::vector<KeyPart>& a, const std::vector<KeyPart>& b);

}  // namespace knotlight
