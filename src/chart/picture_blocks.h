// How far one picture is from another: over blocks of 8 x 8 pixels, which even out most of the
// noise of single pixels and leave what an eye would see.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/image_io.h"
#include "pipeline/scene_setup.h"
#include "reference/path_film.h"

namespace knotlight {

class PictureBlocks {
 public:
  // The blocks all of whose pixels see a translucent object at their centre.
  explicit PictureBlocks(const PreparedScene& prepared);

  bool empty() const { return corners_.empty(); }
  // Mean luminance of each block, W/(length^2 sr).
  Eigen::VectorXd means(const Image& picture) const;

  // A path-traced picture: its means, and the standard error of each.
  struct Judged {
    Eigen::VectorXd means, errors;
  };
  Judged means(const PathFilm& film) const;

 private:
  template <typename Value>
  Eigen::VectorXd mean_of(const Value& value) const;

  int width_ = 0;
  std::vector<std::pair<int, int>> corners_;
};

// Root mean square of a - b over the mean of b. noise: standard errors of b, whose squares are
// taken off (0 if they explain all); empty: b is exact.
double block_error(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                   const Eigen::VectorXd& noise = {});

}  // namespace knotlight
