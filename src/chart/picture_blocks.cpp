#include "chart/picture_blocks.h"

#include <algorithm>
#include <cmath>

#include "compare/figures.h"
#include "trace/camera_rays.h"

namespace knotlight {
namespace {

constexpr int side = 8;  // pixels

}  // namespace

PictureBlocks::PictureBlocks(const PreparedScene& prepared)
    : width_(prepared.scene.camera.width_px) {
  const CameraRays rays(prepared.scene.camera);
  const auto seen = [&](int x, int y) {
    const auto hit = prepared.caster->nearest(rays.ray(x + 0.5, y + 0.5));
    return hit && prepared.scene.objects[hit->object].translucent() != nullptr;
  };
  for (int y = 0; y + side <= prepared.scene.camera.height_px; y += side)
    for (int x = 0; x + side <= width_; x += side) {
      bool covered = true;
      for (int i = 0; covered && i < side * side; ++i) covered = seen(x + i % side, y + i / side);
      if (covered) corners_.emplace_back(x, y);
    }
}

template <typename Value>
Eigen::VectorXd PictureBlocks::mean_of(const Value& value) const {
  Eigen::VectorXd means(static_cast<Eigen::Index>(corners_.size()));
  for (std::size_t b = 0; b < corners_.size(); ++b) {
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i)
      sum += value(static_cast<std::size_t>(corners_[b].second + i / side) * width_ +
                   corners_[b].first + i % side);
    means[static_cast<Eigen::Index>(b)] = sum / (side * side);
  }
  return means;
}

Eigen::VectorXd PictureBlocks::means(const Image& picture) const {
  return mean_of([&](std::size_t pixel) { return luminance(picture.pixels[pixel]); });
}

PictureBlocks::Judged PictureBlocks::means(const PathFilm& film) const {
  Judged judged{mean_of([&](std::size_t pixel) { return luminance(film.mean(pixel)); }),
                // The channels of one path share its noise: standard errors add up, not variances.
                mean_of([&](std::size_t pixel) {
                  const double error = luminance(film.variance(pixel).sqrt());
                  return error * error;
                })};
  judged.errors = (judged.errors / (side * side)).cwiseSqrt();
  return judged;
}

double block_error(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                   const Eigen::VectorXd& noise) {
  const double explained = noise.size() > 0 ? noise.squaredNorm() : 0.0;
  const double squares = (a - b).squaredNorm() - explained;
  // Comparisons that leave not-a-number as it is.
  return std::sqrt((squares < 0.0 ? 0.0 : squares) / static_cast<double>(b.size())) / b.mean();
}

}  // namespace knotlight
