// How many photons are enough: where a scene leaves their number open, a few are tried first, and
// more are traced only if the noise of the solution calls for them.
#pragma once

#include <cstddef>

#include "pipeline/report.h"

namespace knotlight {

// What to try first when at most so many are allowed.
std::size_t first_photons(std::size_t most);

// With how many the noise of every object's solution will be small beside the tolerance and the
// error of the cells, by a guess from a solution of `tried` of them: `tried` if it is, else more,
// up to `most`, which it also is where the noise is not known or an object has met no photon.
std::size_t photons_needed(const Report& solution, std::size_t tried, std::size_t most,
                           double tolerance);

}  // namespace knotlight
