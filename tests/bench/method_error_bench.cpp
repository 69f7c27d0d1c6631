// The error of `method: bkm_thesis` against exact values, as a Markdown table: the whole pipeline
// on the validation scenes. Not a timing; it lies here because it takes a minute.
//
//   method_error_bench bkm_thesis > table.md
//   method_error_bench grid > table.md
//   method_error_bench grid --quick     one setting and one sphere: that it runs, not what is true
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "reference/slab_p1.h"

namespace knotlight {
namespace {

// U_d on the surface of the index-matched unit sphere, g = 0, beam of irradiance 1 along -z,
// boundary marshak, at z = -1, -0.75, ... 1: a spectral solution of the P1 equations, error < 1e-5.
struct SphereCase {
  double sigma_t, albedo;
  std::array<double, 9> U_d;
};
const SphereCase sphere_cases[] = {
    {5,
     0.99,
     {0.003744257, 0.005305161, 0.008330399, 0.01522122, 0.03063731, 0.04868976, 0.06369354,
      0.07615903, 0.08669092}},
    {20,
     0.9,
     {5.602603e-06, 3.829941e-07, 1.6884e-06, 6.497962e-05, 0.00571846, 0.02650737, 0.04295966,
      0.05611326, 0.06688382}},
    {20,
     0.999,
     {0.0006950245, 0.0009577059, 0.001456252, 0.002682914, 0.01305018, 0.04613824, 0.07692854,
      0.1050077, 0.1307355}},
};

struct Outcome {
  double error, largest;  // relative L2, and max error over max U_d
};

Outcome compare(const std::vector<double>& values, const std::vector<double>& exact) {
  double difference2 = 0.0, exact2 = 0.0, worst = 0.0, top = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    difference2 += (values[i] - exact[i]) * (values[i] - exact[i]);
    exact2 += exact[i] * exact[i];
    worst = std::max(worst, std::abs(values[i] - exact[i]));
    top = std::max(top, std::abs(exact[i]));
  }
  return {std::sqrt(difference2 / exact2), worst / top};
}

struct Timed {
  SolvedChannel channel;
  double seconds;
};

Timed solve(const std::string& scene, const std::vector<std::string>& overrides) {
  RunOptions options;
  options.overrides = overrides;
  options.quiet = true;
  RunContext run(options, false);
  const auto start = std::chrono::steady_clock::now();
  SolvedScene solved =
      solve_scene(prepare_scene(KNOTLIGHT_ROOT "/scenes/validation/" + scene, run), run);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {std::move(solved.objects[0][0]), seconds.count()};
}

// What identifies a run of a method: the settings that are swept, and the figures worth a column.
struct Sweep {
  std::string method, setting;
  std::vector<double> values;
  std::vector<std::string> figures;
};
const Sweep sweeps[] = {
    {"bkm_thesis", "solver.knots", {100, 484, 961}, {"particular_rank", "homogeneous_rank"}},
    {"grid",
     "solver.tolerance",
     {0.04, 0.02, 0.01},
     {"cells", "cell_size_in_transport_mean_free_paths"}},
};

double figure(const ChannelReport& report, const std::string& name) {
  for (const auto& [key, value] : report.figures)
    if (key == name) return value;
  throw std::runtime_error("no figure " + name);
}

void print_row(const std::string& name, const Sweep& sweep, double setting, const Outcome& outcome,
               const Timed& solved) {
  const ChannelReport& report = solved.channel.report;
  fmt::print(
      "| {} | {} | {:.3g} | {:.3g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.2f} |\n", name,
      setting, figure(report, sweep.figures[0]), figure(report, sweep.figures[1]), outcome.error,
      outcome.largest, report.numerical_error, report.noise, report.energy_imbalance,
      solved.seconds);
}

void sphere_rows(const Sweep& sweep, std::span<const SphereCase> cases) {
  for (const SphereCase& c : cases)
    for (const double setting : sweep.values) {
      const Timed solved =
          solve("sphere.yaml",
                {fmt::format("materials.medium.sigma_a={}", c.sigma_t * (1 - c.albedo)),
                 fmt::format("materials.medium.sigma_s={}", c.sigma_t * c.albedo),
                 "solver.method=" + sweep.method, fmt::format("{}={}", sweep.setting, setting)});
      // Uniform in z is uniform in area; the mean over 8 azimuths stands for the axisymmetric
      // field.
      std::vector<double> values, exact;
      for (std::size_t i = 0; i < c.U_d.size(); ++i)
        for (int j = 0; j < 8; ++j) {
          const double z = -1.0 + 0.25 * static_cast<double>(i);
          const double rho = std::sqrt(1.0 - z * z);
          values.push_back(solved.channel.U_d_at(
              Vec3(rho * std::cos(0.3 + 0.7854 * j), rho * std::sin(0.3 + 0.7854 * j), z)));
          exact.push_back(c.U_d[i]);
        }
      print_row(fmt::format("sphere, sigma_t R = {}, albedo {}", c.sigma_t, c.albedo), sweep,
                setting, compare(values, exact), solved);
    }
}

void slab_rows(const Sweep& sweep) {
  for (const double b : {2.0, 10.0})
    for (const double setting : sweep.values) {
      const Medium medium{0.01 * b, 0.99 * b, 0.0, 1.0, 0.0};
      const Timed solved =
          solve("slab.yaml",
                {fmt::format("materials.medium.sigma_a={}", medium.sigma_a),
                 fmt::format("materials.medium.sigma_s={}", medium.sigma_s),
                 "solver.method=" + sweep.method, fmt::format("{}={}", sweep.setting, setting)});
      const SlabP1 slab(medium, Boundary::marshak, 1.0);
      std::vector<double> values, exact;
      for (int i = 0; i <= 10; ++i) {  // along an axis through the middle
        values.push_back(solved.channel.U_d_at(Vec3(0.1, 0.2, 0.1 * i)));
        exact.push_back(slab.U_d(0.1 * i));
      }
      print_row(fmt::format("slab, b = {}, albedo 0.99", b), sweep, setting, compare(values, exact),
                solved);
    }
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  using namespace knotlight;
  const bool quick = argc == 3 && std::string(argv[2]) == "--quick";
  for (Sweep sweep : sweeps)
    if ((argc == 2 || quick) && sweep.method == argv[1]) {
      fmt::print(
          "| case | {} | {} | {} | relative L2 error | max error / max U_d | error estimate of the "
          "solver | "
          "noise | energy imbalance | seconds |\n|---|---|---|---|---|---|---|---|---|---|\n",
          sweep.setting, sweep.figures[0], sweep.figures[1]);
      if (quick) {
        sweep.values.resize(1);
        sphere_rows(sweep, std::span(sphere_cases).first(1));
        return 0;
      }
      sphere_rows(sweep, sphere_cases);
      slab_rows(sweep);
      return 0;
    }
  fmt::print(stderr, "usage: method_error_bench bkm_thesis|grid [--quick]\n");
  return 2;
}
