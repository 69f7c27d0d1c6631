// Henyey-Greenstein phase function [HG41].
#pragma once

#include "core/vec3.h"

namespace knotlight {

// Density per solid angle (integral over the sphere 1) of turning by an angle with cosine `mu`;
// mu = 1 is straight on; g = mean cosine in (-1, 1). Unit 1/sr.
double henyey_greenstein(double mu, double g);

// A direction after scattering of the unit direction w, with that density; u, v uniform in [0, 1).
Vec3 sample_henyey_greenstein(const Vec3& w, double g, double u, double v);

}  // namespace knotlight
