// Random access to the surfaces of several objects: a point for any two numbers.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/shape.h"

namespace knotlight {

class SurfaceSampler {
 public:
  // Shapes with their numbers; they must outlive the sampler.
  explicit SurfaceSampler(const std::vector<std::pair<std::uint32_t, const Shape*>>& shapes);

  double area() const { return pieces_.empty() ? 0.0 : pieces_.back().area_up_to; }

  struct Point {
    SurfacePoint surface;
    std::uint32_t object;  // the number its shape was given with
  };
  // u, v in [0, 1). Density 1/area() per area. Neighbouring u are, but for jumps, neighbours on the
  // surface: numbers that fill the square evenly fill the surfaces evenly.
  Point operator()(double u, double v) const;

 private:
  struct Piece {        // a triangle, or a whole sphere
    double area_up_to;  // of all pieces up to this one
    std::uint32_t object;
    const Shape* shape;
    std::uint32_t triangle;
  };
  std::vector<Piece> pieces_;
};

}  // namespace knotlight
