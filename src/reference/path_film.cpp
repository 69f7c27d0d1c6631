#include "reference/path_film.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/clock.h"
#include "trace/camera_rays.h"

namespace knotlight {
namespace {

constexpr std::size_t pixels_per_chunk = 256;  // small enough to balance a few cores at the end

}  // namespace

PathFilm::PathFilm(const Camera& camera) : width(camera.width_px), height(camera.height_px) {
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  sum.assign(pixels, Spectrum::Zero());
  sum_of_squares.assign(pixels, Spectrum::Zero());
}

Spectrum PathFilm::mean(std::size_t pixel) const {
  return sum[pixel] / static_cast<double>(samples);
}

Spectrum PathFilm::variance(std::size_t pixel) const {
  if (samples < 2) return Spectrum::Zero();
  const auto n = static_cast<double>(samples);
  const Spectrum spread = sum_of_squares[pixel] / n - (sum[pixel] / n).square();
  return spread.max(0.0) / (n - 1.0);
}

void add_samples(PathFilm& film, const PathTracer& tracer, const Camera& camera, std::uint64_t seed,
                 std::uint64_t count, const Workers& workers, Stage& stage) {
  const double start = cpu_seconds();
  const CameraRays rays(camera);
  const std::size_t pixels = film.sum.size();
  workers.for_chunks(
      pixels, pixels_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t pixel = begin; pixel < end; ++pixel) {
          const std::size_t row = pixel / static_cast<std::size_t>(film.width);
          const auto x = static_cast<double>(pixel - row * static_cast<std::size_t>(film.width));
          const auto y = static_cast<double>(row);
          for (std::uint64_t s = film.samples; s < film.samples + count; ++s) {
            Rng rng(seed, Stream::reference, s * pixels + pixel);
            const double dx = rng.uniform();
            const double dy = rng.uniform();
            const Spectrum value = tracer.radiance(rays.ray(x + dx, y + dy), rng);
            film.sum[pixel] += value;
            film.sum_of_squares[pixel] += value.square();
          }
        }
        stage.advance((end - begin) * count);
      });
  film.samples += count;
  film.cpu_seconds += cpu_seconds() - start;
}

double relative_noise(const PathFilm& film) {
  if (film.samples < 2) return std::numeric_limits<double>::quiet_NaN();
  double variance = 0.0;
  double mean = 0.0;
  double noisy = 0.0;
  for (std::size_t p = 0; p < film.sum.size(); ++p) {
    const Spectrum v = film.variance(p);
    if ((v == 0.0).all()) continue;
    variance += v.mean();
    mean += film.mean(p).mean();
    noisy += 1.0;
  }
  return noisy > 0.0 ? std::sqrt(variance * noisy) / mean : 0.0;
}

std::vector<Layer> film_layers(const PathFilm& film) {
  const char* const names = "RGB";
  std::vector<Layer> layers;
  for (const bool variances : {false, true})
    for (int c = 0; c < 3; ++c) {
      Layer layer{std::string(variances ? "variance." : "") + names[c], {}};
      for (std::size_t p = 0; p < film.sum.size(); ++p)
        layer.values.push_back(
            static_cast<float>(variances ? film.variance(p)[c] : film.mean(p)[c]));
      layers.push_back(std::move(layer));
    }
  return layers;
}

Image film_image(const PathFilm& film) {
  Image image{film.width, film.height, {}};
  for (std::size_t p = 0; p < film.sum.size(); ++p) image.pixels.push_back(film.mean(p));
  return image;
}

}  // namespace knotlight
