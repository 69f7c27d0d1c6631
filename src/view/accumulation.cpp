#include "view/accumulation.h"

#include <algorithm>
#include <cmath>

#include "trace/camera_rays.h"

namespace knotlight {
namespace {

// Few enough for cancelled workers to stop within milliseconds.
constexpr std::size_t pixels_per_chunk = 256;
// Additive recurrence in two dimensions [R18]: 1/x and 1/x^2 with x^3 = x + 1.
constexpr double step_x = 0.7548776662466927;
constexpr double step_y = 0.5698402909980532;

double fraction(double x) {
  return x - std::floor(x);
}

int shrunk(int pixels, double factor) {
  return std::max(1, static_cast<int>(std::lround(pixels * factor)));
}

}  // namespace

Accumulation::Accumulation(const Camera& camera, std::uint64_t seed)
    : camera_(camera),
      seed_(seed),
      sums_(static_cast<std::size_t>(camera.width_px) * camera.height_px, Spectrum::Zero()) {}

void Accumulation::add_pass(const RaySample& sample, const Workers& workers) {
  const CameraRays rays(camera_);
  const double dx = fraction(0.5 + passes_ * step_x);
  const double dy = fraction(0.5 + passes_ * step_y);
  const auto width = static_cast<std::size_t>(camera_.width_px);
  const std::uint64_t first = static_cast<std::uint64_t>(passes_) * sums_.size();
  workers.for_chunks(sums_.size(), pixels_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (std::size_t pixel = begin; pixel < end; ++pixel) {
                         Rng rng(seed_, Stream::pixels, first + pixel);
                         const std::size_t row = pixel / width;
                         const auto x = static_cast<double>(pixel - row * width);
                         const auto y = static_cast<double>(row);
                         sums_[pixel] += sample(rays.ray(x + dx, y + dy), rng);
                       }
                     });
  ++passes_;
}

Image Accumulation::mean() const {
  Image image{camera_.width_px, camera_.height_px, sums_};
  for (Spectrum& pixel : image.pixels) pixel /= std::max(1, passes_);
  return image;
}

Camera fitted(Camera camera, int width, int height) {
  const double factor = std::min(static_cast<double>(width) / camera.width_px,
                                 static_cast<double>(height) / camera.height_px);
  camera.width_px = shrunk(camera.width_px, factor);
  camera.height_px = shrunk(camera.height_px, factor);
  return camera;
}

Camera coarse(Camera camera, int stride) {
  camera.width_px = shrunk(camera.width_px, 1.0 / stride);
  camera.height_px = shrunk(camera.height_px, 1.0 / stride);
  return camera;
}

}  // namespace knotlight
