// The studies, each in the file of its name.
#pragma once

#include "study/study.h"

namespace knotlight {

Study manufactured_study();       // fig. 7.1
Study precision_study();          // fig. 7.3
Study layouts_study();            // fig. 7.4-7.6
Study singular_values_study();    // table 7.1, fig. 7.7
Study svd_drivers_study();        // table 7.2
Study oscillation_study();        // fig. 7.8
Study radial_functions_study();   // fig. 7.9, 7.10
Study interior_points_study();    // fig. 7.11
Study knots_study();              // table 7.3, fig. 7.12
Study scaling_study();            // fig. 7.13
Study inversion_study();          // fig. 6.3
Study models_study();             // fig. 7.14
Study rescaling_study();          // ch. 8.2
Study flat_limit_study();         // ch. 8.2
Study boundary_particle_study();  // ch. 8.2
Study heterogeneous_study();      // ch. 8.2

}  // namespace knotlight
