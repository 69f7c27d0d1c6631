#include "cases.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/file_io.h"
#include "meshes.h"
#include "reference/sphere_beam_p1.h"

namespace knotlight {
namespace {

constexpr std::size_t sphere_points = 1200;
constexpr std::uint64_t sphere_seed = 1;

Reference beam_on_sphere(double sigma_t, double albedo) {
  const SphereBeamP1 exact(Medium{sigma_t * (1.0 - albedo), sigma_t * albedo, 0.0, 1.0, 0.0},
                           Boundary::marshak, 1.0);
  const auto points =
      stratified_surface_points(Sphere{}, sphere_points, true, sphere_seed, Stream::check_points);
  Reference reference;
  const auto n = static_cast<Eigen::Index>(points.size());
  reference.positions.resize(3, n);
  reference.U_d.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    reference.positions.col(i) = points[static_cast<std::size_t>(i)].position;
    reference.U_d[i] = exact.U_d(reference.positions.col(i));
  }
  return reference;
}

std::vector<std::string> medium(double sigma_t, double albedo) {
  return {fmt::format("materials.medium.sigma_a={}", sigma_t * (1.0 - albedo)),
          fmt::format("materials.medium.sigma_s={}", sigma_t * albedo)};
}

BarsCase sphere(double sigma_t, double albedo, double bar) {
  return {fmt::format("sphere-{}-{}", sigma_t, albedo),
          "sphere.yaml",
          medium(sigma_t, albedo),
          {},
          [=] { return beam_on_sphere(sigma_t, albedo); },
          bar};
}

BarsCase by_finite_elements(const std::string& name, const std::string& scene,
                            std::vector<std::string> overrides, std::function<void()> make_mesh,
                            double bar) {
  return {name,
          scene,
          std::move(overrides),
          std::move(make_mesh),
          [=] { return read_reference(fmt::format(KNOTLIGHT_ROOT "/tests/bars/{}.csv", name)); },
          bar};
}

// The same case with light that leaves a hollow and enters again, which the reference lacks.
BarsCase with_returning_light(BarsCase c) {
  c.name += "+returning";
  c.overrides.push_back("solver.returning_light=true");
  return c;
}

}  // namespace

std::string made_mesh(const std::string& name) {
  const std::string folder = KNOTLIGHT_ROOT "/.fetched/bars";
  make_output_folder(folder);
  return fmt::format("{}/{}.ply", folder, name);
}

std::vector<BarsCase> bars_cases() {
  const BarsCase torus = by_finite_elements(
      "torus", "torus.yaml", {}, [] { write_ply(made_mesh("torus"), torus_mesh()); }, 0.01);
  const BarsCase bunny = by_finite_elements(
      "bunny", "bunny.yaml", {},
      [] { write_ply(made_mesh("bunny"), mended_bunny(KNOTLIGHT_ROOT "/.fetched/bunny.obj")); },
      0.02);
  const BarsCase knot = by_finite_elements("knot", "knot.yaml", {}, {}, 0.02);
  return {
      sphere(5, 0.99, 0.005),
      sphere(20, 0.9, 0.01),
      sphere(20, 0.999, 0.01),
      sphere(50, 0.99, 0.01),
      torus,
      with_returning_light(torus),
      by_finite_elements("box-16-0.95", "box.yaml", medium(16, 0.95), {}, 0.01),
      by_finite_elements("box-40-0.999", "box.yaml", medium(40, 0.999), {}, 0.015),
      bunny,
      with_returning_light(bunny),
      knot,
      with_returning_light(knot),
      by_finite_elements(
          "bumpy", "bumpy.yaml", {}, [] { write_ply(made_mesh("bumpy"), bumpy_mesh()); }, 0.02),
  };
}

Reference read_reference(const std::string& path) {
  constexpr std::size_t columns = 7;
  std::ifstream in(path);
  std::string line;
  std::vector<std::array<double, columns>> rows;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string field;
    std::array<double, columns>& row = rows.emplace_back();
    for (double& value : row) {
      if (!std::getline(fields, field, ',')) throw std::runtime_error(path + ": a row is short");
      value = std::stod(field);
    }
  }
  if (rows.empty()) throw std::runtime_error(path + ": no reference values");
  Reference reference;
  const auto n = static_cast<Eigen::Index>(rows.size());
  reference.positions.resize(3, n);
  reference.U_d.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& row = rows[static_cast<std::size_t>(i)];
    reference.positions.col(i) = Vec3(row[0], row[1], row[2]);
    reference.U_d[i] = row[6];  // after the normal
  }
  return reference;
}

}  // namespace knotlight
