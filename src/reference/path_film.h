// The sums of a picture that is sampled pass by pass, on disc between passes if need be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image_io.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/vec3.h"
#include "reference/path_tracer.h"
#include "scene/scene.h"

namespace knotlight {

// All samples of a pixel are independent of each other and of those of other pixels.
struct PathFilm {
  int width = 0, height = 0;
  std::uint64_t samples = 0;             // per pixel, in the sums
  double cpu_seconds = 0.0;              // spent on them, by all threads
  std::vector<Spectrum> sum;             // per pixel, W/(length^2 sr)
  std::vector<Spectrum> sum_of_squares;  // per pixel, its square

  explicit PathFilm(const Camera& camera);

  Spectrum mean(std::size_t pixel) const;
  // Of the mean: the sample variance over the number of samples. Zero before there are two.
  Spectrum variance(std::size_t pixel) const;
};

// Adds `count` samples to every pixel: sample s of pixel p is the same whenever it is taken and
// whatever thread takes it, so that the sums depend on nothing but how many there are. The stage
// advances by one per pixel and sample.
void add_samples(PathFilm& film, const PathTracer& tracer, const Camera& camera, std::uint64_t seed,
                 std::uint64_t count, const Workers& workers, Stage& stage);

// Noise over the pixels that have any: root of the mean variance of the mean, over the mean.
// Channels count alike. NaN with fewer than two samples; 0 for a picture without noise.
double relative_noise(const PathFilm& film);

// Red, green, blue: the mean. variance.R, .G, .B: that of the mean.
std::vector<Layer> film_layers(const PathFilm& film);
Image film_image(const PathFilm& film);

// What decides the samples: camera, lights, shapes, materials, seed; not how many there are to be.
std::uint64_t samples_key(const Scene& scene, std::uint64_t seed);

// The film in a file of its own format, whole or not at all.
void write_film(const std::string& path, const PathFilm& film, std::uint64_t key);
// Throws InputError if the file is none of ours, of another version, damaged, or if its samples are
// of another scene or seed (another key).
PathFilm read_film(const std::string& path, const Camera& camera, std::uint64_t key);

}  // namespace knotlight
