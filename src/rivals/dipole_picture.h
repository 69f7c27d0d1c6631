// A whole picture by the dipole, with our camera, lights and mirrors.
#pragma once

#include "core/image_io.h"
#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"
#include "rivals/dipole.h"

namespace knotlight {

// Linear radiance, W/(length^2 sr). Light leaves as L = T(w) M / (pi int 2 mu T dmu) [JB02], T the
// Fresnel transmittance, plus once_scattered if settings say so; M is evaluated at the nodes of the
// surface grid and interpolated, as all our fields are. Same bits for any number of workers. Throws
// InputError if an object emits light.
Image dipole_picture(const PreparedScene& prepared, const DipoleSettings& settings,
                     RunContext& run);

}  // namespace knotlight
