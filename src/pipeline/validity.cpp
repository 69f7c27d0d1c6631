#include "pipeline/validity.h"

#include <fmt/format.h>

namespace knotlight {
namespace {

constexpr double least_reduced_albedo = 0.8;  // absorbs one interaction in five: hardly diffuse
constexpr double least_thickness = 2.0;       // fewer than about two scatterings on the way through

}  // namespace

Validity diffusion_validity(const Shape& shape, const Medium& medium) {
  Validity v;
  v.size = bounds(shape).largest_extent();
  v.size_in_mean_free_paths = v.size * medium.sigma_t();
  v.thickness = 4.0 * volume(shape) / surface_area(shape) * medium.sigma_tr();
  v.lambda_R = 0.5 * v.size * medium.lambda();
  v.reduced_albedo = medium.reduced_albedo();
  if (v.reduced_albedo < least_reduced_albedo)
    v.reasons.push_back(
        fmt::format("reduced albedo {:.3g} is below {}: light is absorbed before it is diffuse",
                    v.reduced_albedo, least_reduced_albedo));
  if (v.thickness < least_thickness)
    v.reasons.push_back(
        fmt::format("mean thickness is {:.3g} transport mean free paths, below {}: light passes "
                    "through before it is diffuse",
                    v.thickness, least_thickness));
  v.valid = v.reasons.empty();
  return v;
}

}  // namespace knotlight
