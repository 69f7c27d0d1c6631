#include "compare/slice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "photon/cell_volume.h"
#include "pipeline/grid_load.h"

namespace knotlight {

ValueMap source_slice(const IncidentLight& light, const PreparedScene& prepared,
                      std::uint32_t object, const Slice& slice) {
  const Object& item = prepared.scene.objects[object];
  const Medium m = item.translucent()->medium(0);
  const FluxGrid& grid = slice.grid;
  std::vector<double> strength(grid.cells(), 0.0);
  const auto add = [&](const Vec3& x, double amount) {
    if (const auto cell = grid.cell_at(x)) strength[*cell] += amount;
  };
  const double per_power =
      3.0 * m.sigma_s * (m.sigma_tr() + m.g * m.sigma_t()) / (4.0 * std::numbers::pi * m.sigma_t());
  // Each half is an estimate of all the light.
  for (const IncidentHalf& half : light.halves) {
    for (const VolumePhoton& photon : half.photons)
      add(photon.position, 0.5 * per_power * photon.power);
    if (light.model == SourceModel::irradiance_sampling)
      for (const PointSource& source : sources_below(half.irradiance, m, *prepared.caster, object))
        add(source.position, 0.5 * source.strength);
  }

  const std::vector<double> volumes = volumes_inside(item.shape, grid);
  const auto n = [&](int axis) { return grid.n[static_cast<std::size_t>(axis)]; };
  ValueMap map{n(slice.right), n(slice.down), {}};
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      std::array<int, 3> index{};
      index[static_cast<std::size_t>(slice.right)] = column;
      index[static_cast<std::size_t>(slice.down)] = map.height - 1 - row;
      const std::size_t cell = grid.number(index);
      map.values.push_back(volumes[cell] > 0.0 ? strength[cell] / volumes[cell]
                                               : std::numeric_limits<double>::quiet_NaN());
    }
  return map;
}

ValueMap decades_below(const ValueMap& map, double largest, double lowest) {
  ValueMap result = map;
  for (double& value : result.values)
    if (!std::isnan(value))
      value = value > 0.0 ? std::max(lowest, std::log10(value / largest)) : lowest;
  return result;
}

}  // namespace knotlight
