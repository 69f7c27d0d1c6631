// An octree over points of a surface where light enters, for sums over all of them in logarithmic
// time [JB02]: what lies in a far cell is one point, at the centre of its power.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "rivals/dipole_kernel.h"

namespace knotlight {

struct EnteringLight {
  Vec3 position = Vec3::Zero();
  double area = 0.0;   // of the surface that it stands for, length^2
  double power = 0.0;  // that enters through this area, W
};

class IrradianceTree {
 public:
  // Points without power are left out. Powers must be finite and not negative.
  explicit IrradianceTree(std::vector<EnteringLight> points);

  std::size_t size() const { return points_.size(); }                           // points with power
  double power() const { return nodes_.empty() ? 0.0 : nodes_.front().power; }  // W

  // sum power_p R_d(|x - x_p|): radiant exitance at x, W/length^2. A cell that x does not lie in
  // counts as one point where its area over the squared distance of its centre of power is at most
  // `solid_angle`, in steradian; 0: never.
  double exitance(const Vec3& x, const DipoleKernel& kernel, double solid_angle) const;

 private:
  struct Node {
    Vec3 center_of_power = Vec3::Zero();
    double power = 0.0;
    double area = 0.0;
    Vec3 cell_center = Vec3::Zero();
    double cell_half = 0.0;   // half of the cell's edge
    std::uint32_t first = 0;  // points of a leaf: first ... first + count
    std::uint32_t count = 0;  // 0: not a leaf
    std::uint32_t skip = 0;   // the node after all that are below this one
  };
  void build(std::uint32_t first, std::uint32_t count, const Vec3& center, double half, int depth);

  std::vector<EnteringLight> points_;  // those of each node side by side
  std::vector<Node> nodes_;            // each before those below it
};

}  // namespace knotlight
