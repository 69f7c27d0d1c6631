#include "study/volume_cells.h"

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

}  // namespace

double VolumeCells::radius() const {
  return std::cbrt(3.0 * volumes.mean() / (4.0 * pi));
}

Points spread_directions(Eigen::Index count) {
  const double turn = pi * (3.0 - std::sqrt(5.0));  // the golden angle
  Points directions(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto at = static_cast<double>(i);
    const double z = 1.0 - (2.0 * at + 1.0) / static_cast<double>(count);
    const double rho = std::sqrt(1.0 - z * z);
    directions.col(i) = Vec3(rho * std::cos(turn * at), rho * std::sin(turn * at), z);
  }
  return directions;
}

VolumeCells cells_of_cube(int n, double side) {
  const Eigen::Index count = static_cast<Eigen::Index>(n) * n * n;
  const double h = side / n;
  VolumeCells cells{Points(3, count),
                    Eigen::VectorXd::Constant(count, h * h * h),
                    {Points(3, count), Points(3, count)}};
  Eigen::Index at = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int l = 0; l < n; ++l, ++at) {
        const Vec3 x = h * Vec3(i + 0.5, j + 0.5, l + 0.5);
        Eigen::Index axis = 0;
        const Vec3 outwards = x - Vec3::Constant(0.5 * side);
        outwards.cwiseAbs().maxCoeff(&axis);
        const bool upper = outwards[axis] > 0.0;
        Vec3 foot = x;
        foot[axis] = upper ? side : 0.0;
        cells.centers.col(at) = x;
        cells.nearest.positions.col(at) = foot;
        cells.nearest.normals.col(at) = (upper ? 1.0 : -1.0) * Vec3::Unit(axis);
      }
  return cells;
}

VolumeCells cells_of_ball(int n) {
  std::vector<Eigen::Index> pieces;
  Eigen::Index count = 0;
  for (int shell = 0; shell < n; ++shell) {
    const double middle = shell + 0.5;  // in thicknesses
    pieces.push_back(std::lround(4.0 * pi * middle * middle));
    count += pieces.back();
  }
  VolumeCells cells{Points(3, count), Eigen::VectorXd(count), {Points(3, count), Points(3, count)}};
  Eigen::Index at = 0;
  for (int shell = 0; shell < n; ++shell) {
    const Eigen::Index own = pieces[static_cast<std::size_t>(shell)];
    const double inner = static_cast<double>(shell) / n, outer = (shell + 1.0) / n;
    const double volume = 4.0 * pi / 3.0 * (std::pow(outer, 3) - std::pow(inner, 3));
    // Neighbouring shells' spirals would lie one on the other.
    const Eigen::AngleAxisd turned(shell, Vec3(0.36, 0.48, 0.8));
    const Points directions = turned.toRotationMatrix() * spread_directions(own);
    cells.centers.middleCols(at, own) = 0.5 * (inner + outer) * directions;
    cells.volumes.segment(at, own).setConstant(volume / static_cast<double>(own));
    cells.nearest.positions.middleCols(at, own) = directions;
    cells.nearest.normals.middleCols(at, own) = directions;
    at += own;
  }
  return cells;
}

VolumeCells chosen_cells(const VolumeCells& cells,
                         const Eigen::Array<bool, Eigen::Dynamic, 1>& keep) {
  const Eigen::Index count = keep.count();
  VolumeCells chosen{
      Points(3, count), Eigen::VectorXd(count), {Points(3, count), Points(3, count)}};
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < cells.size(); ++i) {
    if (!keep[i]) continue;
    chosen.centers.col(at) = cells.centers.col(i);
    chosen.volumes[at] = cells.volumes[i];
    chosen.nearest.positions.col(at) = cells.nearest.positions.col(i);
    chosen.nearest.normals.col(at++) = cells.nearest.normals.col(i);
  }
  return chosen;
}

}  // namespace knotlight
