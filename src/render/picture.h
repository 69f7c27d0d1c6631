// The ray-traced picture of a scene whose translucent objects have been solved.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/image_io.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "render/exitance.h"
#include "render/surface_grid.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// What the picture needs of one solved translucent object.
struct GlowingSurface {
  SurfaceGrid grid;
  std::vector<Eigen::VectorXd> U_d;      // per channel, one value per grid node, W/(length^2 sr)
  std::vector<LeavingRadiance> leaving;  // per channel
  // U_d holds U_ri too, that of light which is diffuse from the moment it enters (the source model
  // boundary_flux); entered / (2 pi) has to come off.
  bool counts_entering_light = false;
};

// How often render_picture advances its stage.
std::size_t picture_tiles(const Camera& camera);

// Linear radiance, W/(length^2 sr), per pixel: the mean over stratified samples (box filter).
// surfaces: one per scene object, empty for diffuse ones. Same bits for any number of workers.
Image render_picture(const Scene& scene, const RayCaster& caster,
                     const std::vector<std::optional<GlowingSurface>>& surfaces, std::uint64_t seed,
                     const Workers& workers, Stage& stage);

}  // namespace knotlight
