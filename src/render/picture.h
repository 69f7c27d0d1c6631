// The ray-traced picture of a scene whose translucent objects have been solved.
#pragma once

#include "core/image_io.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "render/shading.h"

namespace knotlight {

// How often render_picture advances its stage.
std::size_t picture_tiles(const Camera& camera);

// Parts of a picture, pixel by pixel (ScatteredLight).
struct PictureParts {
  Image once, more;
};

// Linear radiance, W/(length^2 sr), per pixel: the mean over stratified samples (box filter). Same
// bits for any number of workers. parts: also told what of it was scattered how often.
Image render_picture(const Camera& camera, const Shading& shading, std::uint64_t seed,
                     const Workers& workers, Stage& stage, PictureParts* parts = nullptr);

}  // namespace knotlight
