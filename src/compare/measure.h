// From runs of source models to the figures of a comparison.
#pragma once

#include "compare/figures.h"

namespace knotlight {

// Surface points of all objects, each standing for `area` of it.
struct SurfaceChecks {
  std::vector<SurfaceSamples> objects;  // one per translucent object
  Eigen::VectorXd areas;                // in the order of the objects
};
SurfaceChecks surface_checks(const PreparedScene& prepared, std::uint64_t seed);

// U_d of a run at the checks, in their order.
Eigen::VectorXd at_checks(const ModelRun& run, const PreparedScene& prepared,
                          const SurfaceChecks& checks, std::uint64_t seed, const Workers& workers);

// U_d of a run as the camera sees it, channel 0; NaN where it sees no translucent object.
ValueMap seen_U_d(const ModelRun& run, const PreparedScene& prepared, const SeenSurface& seen,
                  std::uint64_t seed, const Workers& workers);

// (a - b) over the rms of b, over places where both are numbers; NaN elsewhere.
ValueMap relative_difference(const ValueMap& a, const ValueMap& b);

// Luminance of a picture where `seen` has a translucent object; NaN elsewhere.
ValueMap luminance_map(const Image& picture, const SeenSurface& seen);

// Root mean square of a difference map; NaN if it has no values.
double rms(const ValueMap& map);

// U_d of a run at the cells of each line. What boundary_flux is freed from is the truth's U_ri.
std::vector<Eigen::VectorXd> along_lines(const ModelRun& run, std::size_t object,
                                         const Comparison& comparison, const Workers& workers);

}  // namespace knotlight
