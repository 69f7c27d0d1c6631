#include "core/environment_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Below the horizon of this pixel row (0..height): the cosine of its polar angle.
double row_edge_z(int row, int height) {
  return std::cos(pi * row / height);
}

// The bin of a cumulative table in which x in [0, 1) lies, and where in it (0..1). Bins of no
// width are never chosen.
struct BinPosition {
  std::size_t bin;
  double fraction;
};
BinPosition locate(const double* cdf, std::size_t bins, double x) {
  const double* above = std::upper_bound(cdf, cdf + bins + 1, x);
  assert(above != cdf && above != cdf + bins + 1);
  const double* below = above - 1;
  return {static_cast<std::size_t>(below - cdf), (x - *below) / (*above - *below)};
}

// Sums `weights` into a table from 0 to exactly 1; all zero: bins of equal width.
void accumulate(const std::vector<double>& weights, double* cdf) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    cdf[i] = sum;
    sum += weights[i];
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    cdf[i] =
        sum > 0.0 ? cdf[i] / sum : static_cast<double>(i) / static_cast<double>(weights.size());
  }
  cdf[weights.size()] = 1.0;
}

}  // namespace

EnvironmentMap::EnvironmentMap(int width, int height, std::vector<Spectrum> pixels)
    : width_(width),
      height_(height),
      pixels_(std::move(pixels)),
      row_cdf_(static_cast<std::size_t>(height) + 1),
      column_cdf_(static_cast<std::size_t>(height) * (static_cast<std::size_t>(width) + 1)) {
  assert(width > 0 && height > 0);
  assert(pixels_.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));

  const auto brightness = [&](int column, int row) {
    const int wrapped = (column + width_) % width_;
    const int clamped = std::clamp(row, 0, height_ - 1);
    return pixels_[static_cast<std::size_t>(clamped) * width_ + wrapped].mean();
  };
  // The mean over a pixel of the linear interpolation between its centre and its neighbours' is
  // 1/8, 3/4, 1/8 of the three along each axis. A black pixel next to a bright one shines after
  // interpolation, so it must be found by sampling too.
  const auto mean_along_row = [&](int column, int row) {
    return 0.125 * (brightness(column - 1, row) + brightness(column + 1, row)) +
           0.75 * brightness(column, row);
  };

  std::vector<double> row_weights(static_cast<std::size_t>(height));
  std::vector<double> column_weights(static_cast<std::size_t>(width));
  double total = 0.0;
  for (int row = 0; row < height_; ++row) {
    double sum = 0.0;
    for (int column = 0; column < width_; ++column) {
      const double weight =
          0.125 * (mean_along_row(column, row - 1) + mean_along_row(column, row + 1)) +
          0.75 * mean_along_row(column, row);
      column_weights[static_cast<std::size_t>(column)] = weight;
      sum += weight;
    }
    const double solid_angle = row_edge_z(row, height_) - row_edge_z(row + 1, height_);
    row_weights[static_cast<std::size_t>(row)] = sum * solid_angle;
    total += sum;
    accumulate(column_weights, &column_cdf_[static_cast<std::size_t>(row) * (width_ + 1)]);
  }
  if (total == 0.0) {  // a black map: every direction alike
    for (int row = 0; row < height_; ++row) {
      row_weights[static_cast<std::size_t>(row)] =
          row_edge_z(row, height_) - row_edge_z(row + 1, height_);
    }
  }
  accumulate(row_weights, row_cdf_.data());
}

Spectrum EnvironmentMap::radiance(const Vec3& w) const {
  const double azimuth = std::atan2(w.y(), w.x());  // -pi..pi
  const double polar = std::atan2(std::hypot(w.x(), w.y()), w.z());
  // In pixels, measured from the centre of the first one.
  const double column = (azimuth + pi) / (2.0 * pi) * width_ - 0.5;
  const double row = std::clamp(polar / pi * height_ - 0.5, 0.0, height_ - 1.0);

  const int column_0 = static_cast<int>(std::floor(column));  // -1..width
  const int row_0 = static_cast<int>(row);
  const double s = column - column_0;
  const double t = row - row_0;
  const auto pixel = [&](int i, int j) -> const Spectrum& {
    const int wrapped = (i + width_) % width_;
    return pixels_[static_cast<std::size_t>(std::min(j, height_ - 1)) * width_ + wrapped];
  };
  return (1.0 - t) * ((1.0 - s) * pixel(column_0, row_0) + s * pixel(column_0 + 1, row_0)) +
         t * ((1.0 - s) * pixel(column_0, row_0 + 1) + s * pixel(column_0 + 1, row_0 + 1));
}

EnvironmentMap::Sample EnvironmentMap::sample(double u, double v) const {
  const BinPosition row = locate(row_cdf_.data(), static_cast<std::size_t>(height_), v);
  const double* columns = &column_cdf_[row.bin * (static_cast<std::size_t>(width_) + 1)];
  const BinPosition column = locate(columns, static_cast<std::size_t>(width_), u);

  const double z_top = row_edge_z(static_cast<int>(row.bin), height_);
  const double z_bottom = row_edge_z(static_cast<int>(row.bin) + 1, height_);
  const double z = z_top + row.fraction * (z_bottom - z_top);
  const double pixel_azimuth = 2.0 * pi / width_;
  const double azimuth = -pi + (static_cast<double>(column.bin) + column.fraction) * pixel_azimuth;
  const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));

  const double probability =
      (row_cdf_[row.bin + 1] - row_cdf_[row.bin]) * (columns[column.bin + 1] - columns[column.bin]);
  return {Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z),
          probability / (pixel_azimuth * (z_top - z_bottom))};
}

double EnvironmentMap::pdf(const Vec3& w) const {
  const double azimuth = std::atan2(w.y(), w.x());  // -pi..pi
  const double polar = std::atan2(std::hypot(w.x(), w.y()), w.z());
  const auto pixel = [](double fraction, int count) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(fraction * count), 0, count - 1));
  };
  const std::size_t row = pixel(polar / pi, height_);
  const std::size_t column = pixel((azimuth + pi) / (2.0 * pi), width_);
  const double* columns = &column_cdf_[row * (static_cast<std::size_t>(width_) + 1)];
  const double z_top = row_edge_z(static_cast<int>(row), height_);
  const double z_bottom = row_edge_z(static_cast<int>(row) + 1, height_);
  return (row_cdf_[row + 1] - row_cdf_[row]) * (columns[column + 1] - columns[column]) /
         (2.0 * pi / width_ * (z_top - z_bottom));
}

}  // namespace knotlight
