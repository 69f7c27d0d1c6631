// A picture of the surroundings at infinity in the latitude-longitude layout, z up: column 0 looks
// along -x, the middle column along +x, the columns go counter-clockwise seen from above; the top
// row is +z.
#pragma once

#include <string>
#include <vector>

#include "core/vec3.h"

namespace knotlight {

class EnvironmentMap {
 public:
  // pixels: width * height values, row by row from the top, W/(length^2 sr), each >= 0.
  EnvironmentMap(int width, int height, std::vector<Spectrum> pixels);

  int width() const { return width_; }
  const std::vector<Spectrum>& pixels() const { return pixels_; }

  // Radiance arriving from the unit direction w (pointing away from the scene), by bilinear
  // interpolation.
  Spectrum radiance(const Vec3& w) const;

  struct Sample {
    Vec3 direction;  // pointing away from the scene
    double pdf;      // 1/sr
  };
  // A direction whose pixel is chosen in proportion to its solid angle times the interpolated
  // radiance averaged over it (mean of the channels), so that every direction that shines can be
  // chosen; uniform over the pixel's solid angle. A black map: uniform. u, v uniform in [0, 1).
  Sample sample(double u, double v) const;
  // The density with which sample() chooses the unit direction w, 1/sr.
  double pdf(const Vec3& w) const;

 private:
  int width_, height_;
  std::vector<Spectrum> pixels_;
  std::vector<double> row_cdf_;     // height + 1
  std::vector<double> column_cdf_;  // height x (width + 1)
};

}  // namespace knotlight
