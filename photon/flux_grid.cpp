#include "photon/flux_grid.h"

namespace knotlight {

Bounds FluxGrid::cell_bounds(std::size_t number) const {
  const auto c = static_cast<int>(number);
  const std::array<int, 3> i{c % n[0], c / n[0] % n[1], c / n[0] / n[1]};
  Bounds b;
  for (int a = 0; a < 3; ++a) {
    b.lo[a] = border(a, i[a]);
    b.hi[a] = border(a, i[a] + 1);
  }
  return b;
}

std::optional<std::size_t> FluxGrid::cell_at(const Vec3& p) const {
  std::array<int, 3> i{};
  for (int a = 0; a < 3; ++a) {
    if (!(p[a] >= lo[a] && p[a] < hi[a])) return std::nullopt;
    i[a] = std::min(static_cast<int>((p[a] - lo[a]) / (hi[a] - lo[a]) * n[a]), n[a] - 1);
  }
  return number(i);
}

}  // namespace knotlight
