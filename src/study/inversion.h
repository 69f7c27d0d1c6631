// What tests ask of the study of inversion.
#pragma once

#include "core/bkm_choices.h"

namespace knotlight {

// The manufactured problem with n x n knots per face and Gaussians of width c (length), its two
// matrices inverted by these methods.
struct Inversion {
  double source_condition = 0.0;  // largest over smallest singular value found
  double boundary_condition = 0.0;
  double error = 0.0;  // largest, away from knots
};
Inversion inverted(int n, double c, DenseMethod source_by, DenseMethod boundary_by);

}  // namespace knotlight
