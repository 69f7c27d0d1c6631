// How large an object is in the units that matter, and whether diffusion can describe it.
#pragma once

#include <string>
#include <vector>

#include "core/medium.h"
#include "core/shape.h"

namespace knotlight {

struct Validity {
  double size = 0.0;                     // largest extent, length
  double size_in_mean_free_paths = 0.0;  // size * sigma_t
  double thickness = 0.0;  // mean chord 4 V / S in transport mean free paths 1/sigma_tr
  double lambda_R = 0.0;   // lambda times half the largest extent
  double reduced_albedo = 0.0;
  bool valid = true;
  std::vector<std::string> reasons;  // why not, one sentence each; empty if valid
};

// Diffusion holds where light is scattered many times before it leaves or is absorbed: P1 against
// exact slabs is off by 0.1-3 % at reduced albedo >= 0.9 and two or more transport mean free paths,
// and loses several times that below (docs/theory.md, "Validity").
Validity diffusion_validity(const Shape& shape, const Medium& medium);

}  // namespace knotlight
