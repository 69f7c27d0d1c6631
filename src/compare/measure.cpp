#include "compare/measure.h"

#include <cmath>
#include <limits>

namespace knotlight {
namespace {

constexpr std::size_t checks_per_object = 2048;  // an rms over so many is good to 2 %
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

SurfaceChecks surface_checks(const PreparedScene& prepared, std::uint64_t seed) {
  SurfaceChecks checks;
  std::vector<double> areas;
  for (const std::uint32_t object : prepared.translucent) {
    const Shape& shape = prepared.scene.objects[object].shape;
    const auto points = stratified_surface_points(shape, checks_per_object, true, seed + object,
                                                  Stream::check_points);
    areas.insert(areas.end(), points.size(),
                 surface_area(shape) / static_cast<double>(points.size()));
    checks.objects.push_back(columns(points));
  }
  checks.areas =
      Eigen::Map<const Eigen::VectorXd>(areas.data(), static_cast<Eigen::Index>(areas.size()));
  return checks;
}

Eigen::VectorXd at_checks(const ModelRun& run, const PreparedScene& prepared,
                          const SurfaceChecks& checks, std::uint64_t seed, const Workers& workers) {
  Eigen::VectorXd values(checks.areas.size());
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < checks.objects.size(); ++i) {
    const SurfaceSamples& points = checks.objects[i];
    values.segment(first, points.positions.cols()) =
        surface_U_d(run, prepared, i, points.positions, points.normals, seed, workers);
    first += points.positions.cols();
  }
  return values;
}

ValueMap seen_U_d(const ModelRun& run, const PreparedScene& prepared, const SeenSurface& seen,
                  std::uint64_t seed, const Workers& workers) {
  ValueMap map{seen.width, seen.height,
               std::vector<double>(static_cast<std::size_t>(seen.width) * seen.height, nothing)};
  for (std::size_t i = 0; i < seen.parts.size(); ++i) {
    const SeenSurface::Part& part = seen.parts[i];
    const Eigen::VectorXd values =
        surface_U_d(run, prepared, i, part.surface.positions, part.surface.normals, seed, workers);
    for (std::size_t p = 0; p < part.pixels.size(); ++p)
      map.values[part.pixels[p]] = values[static_cast<Eigen::Index>(p)];
  }
  return map;
}

double rms(const ValueMap& map) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : map.values) {
    if (std::isnan(value)) continue;
    sum += value * value;
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

ValueMap relative_difference(const ValueMap& a, const ValueMap& b) {
  ValueMap map{a.width, a.height, {}};
  const double whole = rms(b);
  for (std::size_t i = 0; i < a.values.size(); ++i)
    map.values.push_back((a.values[i] - b.values[i]) / whole);
  return map;
}

ValueMap luminance_map(const Image& picture, const SeenSurface& seen) {
  ValueMap map{picture.width, picture.height, std::vector<double>(picture.pixels.size(), nothing)};
  for (const SeenSurface::Part& part : seen.parts)
    for (const std::size_t pixel : part.pixels)
      map.values[pixel] = luminance(picture.pixels[pixel]);
  return map;
}

std::vector<Eigen::VectorXd> along_lines(const ModelRun& run, std::size_t object,
                                         const Comparison& comparison, const Workers& workers) {
  std::vector<Eigen::VectorXd> values;
  for (const std::vector<LineCell>& cells : comparison.line_cells) {
    Points positions(3, static_cast<Eigen::Index>(cells.size()));
    Eigen::VectorXd U_ri(positions.cols());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const auto cell = static_cast<Eigen::Index>(cells[i].cell);
      positions.col(column) = comparison.truth.centers.col(cell);
      U_ri[column] = comparison.truth.U_ri[cell];
    }
    values.push_back(inner_U_d(run, object, positions, U_ri, workers));
  }
  return values;
}

}  // namespace knotlight
