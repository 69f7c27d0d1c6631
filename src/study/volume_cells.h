// A body's volume as points, each with a cell of its own: where what is spread out over the volume
// becomes charges.
#pragma once

#include <Eigen/Core>

#include "core/shape.h"

namespace knotlight {

struct VolumeCells {
  Points centers;           // 3 x N, length
  Eigen::VectorXd volumes;  // N, length^3; their sum is the body's
  SurfaceSamples nearest;   // N: the surface point nearest to each, with its outward unit normal

  Eigen::Index size() const { return centers.cols(); }
  // Radius of the ball as large as a cell in the mean, length.
  double radius() const;
};

// n^3 cubes of [0, side]^3.
VolumeCells cells_of_cube(int n, double side);
// The ball |x| < 1 in n shells of one thickness, each cut into pieces about as wide as thick; some
// 4 pi n^3 / 3.
VolumeCells cells_of_ball(int n);

// Those for which keep[i] is true.
VolumeCells chosen_cells(const VolumeCells& cells,
                         const Eigen::Array<bool, Eigen::Dynamic, 1>& keep);

// `count` unit vectors, evenly spread: a Fibonacci spiral [G10].
Points spread_directions(Eigen::Index count);

}  // namespace knotlight
