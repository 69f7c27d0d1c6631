// How fast sampling error falls with the number of rays: random collisions against expected values.
//   expected_values_bench DIR [--quick]    writes expected-values.csv and its charts there; quick:
//                                          few rays, that it runs, not what is true
// The error is that of the solved U_d on the surface (relative rms at 512 points) on one grid,
// against 16 million rays on the same grid, so that neither the grid's error nor diffusion's is in
// it. rms over two replicates each.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>

#include "core/file_io.h"
#include "grid/solver.h"
#include "photon/first_light_tracer.h"
#include "photon/photon_tracer.h"
#include "report/chart.h"
#include "report/csv.h"

namespace knotlight {
namespace {

using Photons = std::vector<VolumePhoton>;

struct Effort {
  std::size_t most_rays = 2'560'000;
  std::size_t converged_rays = 16'000'000;
};
constexpr Effort quick{40'000, 80'000};
constexpr double cell = 0.025;  // half a transport mean free path

struct Case {
  std::string name;
  std::vector<Light> lights;
};

struct Scheme {
  std::string name;
  std::function<Photons(const Scene&, const RayCaster&, std::size_t rays, std::uint64_t seed)>
      trace;
};

Photons collisions(const Scene& scene, const RayCaster& caster, std::size_t rays,
                   std::uint64_t seed) {
  TracerOptions options;
  options.photons = rays;
  options.seed = seed;
  Stages stages(false);
  Stage stage(stages, "photons", rays);
  return std::move(trace_photons(scene, caster, 0, options, Workers(1), stage).photons[0]);
}

Scheme expected(const std::string& name, int points, FirstLightOptions::Depths depths) {
  return {name,
          [=](const Scene& scene, const RayCaster& caster, std::size_t rays, std::uint64_t seed) {
            FirstLightOptions options;
            options.rays = rays;
            options.points_per_ray = points;
            options.depths = depths;
            options.seed = seed;
            Stages stages(false);
            Stage stage(stages, "photons", rays);
            return std::move(
                trace_first_light(scene, caster, 0, options, Workers(1), stage).photons[0]);
          }};
}

// The ball of optical radius 20, albedo 0.9, on the grid that the default tolerance asks for.
class Ball {
 public:
  Ball() {
    TranslucentMaterial material;
    material.sigma_a = Spectrum::Constant(medium_.sigma_a);
    material.sigma_s = Spectrum::Constant(medium_.sigma_s);
    scene_.objects = {{"ball", Sphere{}, material}};
    geometry_ = std::make_shared<GridGeometry>(scene_.objects[0].shape, cell, Workers(1));
    const DiffusionCoefficients c = diffusion_coefficients(medium_, Boundary::marshak);
    solver_ = std::make_unique<GridSolver>(geometry_, c.lambda, c.k);
    const auto points =
        stratified_surface_points(scene_.objects[0].shape, 512, true, 1, Stream::check_points);
    positions_.resize(3, static_cast<Eigen::Index>(points.size()));
    normals_.resizeLike(positions_);
    for (Eigen::Index i = 0; i < positions_.cols(); ++i) {
      positions_.col(i) = points[static_cast<std::size_t>(i)].position;
      normals_.col(i) = points[static_cast<std::size_t>(i)].normal;
    }
    caster_ = std::make_unique<RayCaster>(std::vector<const Shape*>{&scene_.objects[0].shape});
  }

  void set_lights(const std::vector<Light>& lights) { scene_.lights = lights; }

  // U_d on the surface; seconds gets the time of tracing and counting into cells.
  Eigen::VectorXd solve(const Scheme& scheme, std::size_t rays, std::uint64_t seed,
                        double& seconds) const {
    const auto start = std::chrono::steady_clock::now();
    GridLoad load(*geometry_);
    const double strength =
        3.0 * medium_.sigma_s * medium_.sigma_tr() / (4.0 * std::numbers::pi * medium_.sigma_t());
    for (const VolumePhoton& p : scheme.trace(scene_, *caster_, rays, seed))
      load.add_source(p.position, strength * p.power);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return solver_->solve(load).field.values(positions_, normals_);
  }

 private:
  Medium medium_{2.0, 18.0, 0.0, 1.0, 0.0};
  Scene scene_;
  std::shared_ptr<const GridGeometry> geometry_;
  std::unique_ptr<GridSolver> solver_;
  std::unique_ptr<RayCaster> caster_;
  Points positions_, normals_;
};

int run(const std::string& folder, const Effort& effort) {
  const std::array<Case, 2> cases{
      {{"beam", {DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()}}},
       {"area light",
        {AreaLight{Vec3(0, 0, 3), Vec3::UnitX(), -Vec3::UnitY(), Spectrum::Ones()}}}}};
  using Depths = FirstLightOptions::Depths;
  const std::vector<Scheme> schemes = {
      {"random collisions", collisions},
      expected("expected values, 1 depth per ray", 1, Depths::stratified),
      expected("expected values, 4 depths per ray", 4, Depths::stratified),
      expected("expected values, 4 Gauss points per ray", 4, Depths::gauss)};
  Ball ball;
  std::vector<std::vector<std::string>> rows;
  for (const Case& c : cases) {
    ball.set_lights(c.lights);
    Chart chart{
        "U_d of a ball under a " + c.name, "rays", "relative rms sampling error", true, true, {}};
    double unused = 0.0;
    const Eigen::VectorXd exact = ball.solve(schemes[1], effort.converged_rays, 99, unused);
    for (const Scheme& scheme : schemes) {
      ChartSeries series;
      series.name = scheme.name;
      for (std::size_t rays = 10'000; rays <= effort.most_rays; rays *= 4) {
        double squares = 0.0, seconds = 0.0;
        for (const std::uint64_t seed : {1, 2}) {
          double once = 0.0;
          squares += (ball.solve(scheme, rays, seed, once) - exact).squaredNorm();
          seconds += 0.5 * once;
        }
        const double error = std::sqrt(0.5 * squares) / exact.norm();
        series.x.push_back(static_cast<double>(rays));
        series.y.push_back(error);
        rows.push_back({c.name, scheme.name, std::to_string(rays), csv_number(error),
                        fmt::format("{:.3f}", seconds)});
        fmt::print("{:<12}{:<42}{:>9} {:.5f} {:.3f} s\n", c.name, scheme.name, rays, error,
                   seconds);
      }
      const double slope = std::log(series.y.back() / series.y.front()) /
                           std::log(series.x.back() / series.x.front());
      fmt::print("{:<12}{:<42}slope {:.2f}\n", c.name, scheme.name, slope);
      chart.series.push_back(series);
    }
    write_text_file(fmt::format("{}/expected-values-{}.svg", folder, c.name.substr(0, 4)),
                    chart_svg(chart));
  }
  write_text_file(folder + "/expected-values.csv",
                  csv_text({"light", "scheme", "rays", "relative_error", "seconds"}, rows));
  return 0;
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  const bool few = argc == 3 && std::string(argv[2]) == "--quick";
  if (argc != 2 && !few) {
    fmt::print(stderr, "usage: expected_values_bench DIR [--quick]\n");
    return 2;
  }
  return knotlight::run(argv[1], few ? knotlight::quick : knotlight::Effort{});
}
