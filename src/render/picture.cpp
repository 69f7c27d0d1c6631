#include "render/picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trace/camera_rays.h"

namespace knotlight {
namespace {

// Its multiples fill [0, 1) evenly, however many they are.
constexpr double golden_ratio = std::numbers::phi - 1.0;
constexpr int tile_size = 16;  // pixels; small enough to balance two cores at the end

// Mean over the samples of one pixel, stratified in as many cells as there are samples.
Spectrum pixel(const Camera& camera, const CameraRays& rays, const Shading& shading, int x, int y,
               std::uint64_t seed, ScatteredLight* scattered) {
  Rng rng(seed, Stream::pixels, static_cast<std::uint64_t>(y) * camera.width_px + x);
  // As square as divides evenly: every cell of the pixel gets exactly one sample.
  int columns = static_cast<int>(std::sqrt(camera.samples));
  while (camera.samples % columns != 0) --columns;
  const int rows = camera.samples / columns;
  Spectrum sum = Spectrum::Zero();
  double depth_sample = rng.uniform();
  for (int s = 0; s < camera.samples; ++s) {
    const int column = s % columns;
    const int row = s / columns;
    const double dx = (column + rng.uniform()) / columns;
    const double dy = (row + rng.uniform()) / rows;
    sum += shading.radiance(rays.ray(x + dx, y + dy), depth_sample, rng, scattered);
    depth_sample += golden_ratio;
    depth_sample -= std::floor(depth_sample);
  }
  if (scattered != nullptr) {
    scattered->once /= camera.samples;
    scattered->more /= camera.samples;
  }
  return sum / camera.samples;
}

int tiles_across(int pixels) {
  return (pixels + tile_size - 1) / tile_size;
}

}  // namespace

std::size_t picture_tiles(const Camera& camera) {
  return static_cast<std::size_t>(tiles_across(camera.width_px)) *
         static_cast<std::size_t>(tiles_across(camera.height_px));
}

Image render_picture(const Camera& camera, const Shading& shading, std::uint64_t seed,
                     const Workers& workers, Stage& stage, PictureParts* parts) {
  const CameraRays rays(camera);
  const int width = camera.width_px;
  const int height = camera.height_px;
  Image image{width, height, std::vector<Spectrum>(static_cast<std::size_t>(width) * height)};
  if (parts != nullptr) *parts = {image, image};
  const int columns = tiles_across(width);
  workers.for_chunks(picture_tiles(camera), 1, [&](std::size_t tile, std::size_t, std::size_t) {
    const int x0 = static_cast<int>(tile) % columns * tile_size;
    const int y0 = static_cast<int>(tile) / columns * tile_size;
    for (int y = y0; y < std::min(height, y0 + tile_size); ++y)
      for (int x = x0; x < std::min(width, x0 + tile_size); ++x) {
        ScatteredLight scattered;
        image.at(x, y) =
            pixel(camera, rays, shading, x, y, seed, parts != nullptr ? &scattered : nullptr);
        if (parts == nullptr) continue;
        parts->once.at(x, y) = scattered.once;
        parts->more.at(x, y) = scattered.more;
      }
    stage.advance();
  });
  return image;
}

}  // namespace knotlight
