#include "measure.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "child.h"
#include "core/errors.h"
#include "core/not_finite.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "report/csv.h"

namespace knotlight {
namespace {

using Json = nlohmann::json;

constexpr int trusted = 0, failed = 1, refused = 2, untrusted = 3;  // the command line's exit codes

// Reasons start with the name of what was taken.
std::string first_word(const std::string& reason) {
  return reason.substr(0, reason.find_first_of(" :,"));
}

// Where the reference's points, rounded to so many digits, lie on the surface.
Points on_surface(const Points& points, const PreparedScene& prepared) {
  Points result(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    result.col(i) =
        prepared.caster->nearest_surface_point(points.col(i), prepared.translucent[0]).position;
  return result;
}

// Of this process so far, user and system.
double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// As text, since JSON has neither infinity nor not-a-number.
std::string text(double value) {
  return fmt::format("{}", value);
}

double triangle_count(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  return mesh != nullptr ? static_cast<double>(mesh->triangles.size()) : nan;
}

void solve(const BarsCase& c, const Reference& reference, const RunOptions& options, Json& out) {
  RunContext run(options, false);
  const auto start = std::chrono::steady_clock::now();
  const double cpu_start = cpu_seconds();
  const PreparedScene prepared = prepare_scene(KNOTLIGHT_ROOT "/tests/bars/scenes/" + c.scene, run);
  const SolvedScene solved = solve_scene(prepared, run);
  Eigen::VectorXd values;
  {
    const Stage stage(run.stages, "values", 0);
    values = solved.objects[0][0].U_d(on_surface(reference.positions, prepared));
  }
  out["seconds"] =
      text(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  out["cpu_seconds"] = text(cpu_seconds() - cpu_start);
  const Eigen::VectorXd error = values - reference.U_d;
  const ObjectReport& object = solved.report.objects[0];
  const ChannelReport& channel = object.channels[0];
  out["triangles"] = text(triangle_count(prepared.scene.objects[prepared.translucent[0]].shape));
  out["l2_error"] = text(error.norm() / reference.U_d.norm());
  out["largest_error"] =
      text(error.lpNorm<Eigen::Infinity>() / reference.U_d.lpNorm<Eigen::Infinity>());
  out["error_estimate"] = text(channel.error_estimate);
  out["numerical_error"] = text(channel.numerical_error);
  out["noise"] = text(channel.noise);
  out["energy_imbalance"] = text(channel.energy_imbalance);
  out["chosen"] = first_word(object.method);
  out["source"] = first_word(object.source);
  out["stages"] = run.stages.seconds();
  out["exit_code"] = solved.report.failures.empty() ? trusted : untrusted;
  if (!solved.report.failures.empty()) out["note"] = solved.report.failures.front();
}

std::string work(const BarsCase& c, const RunOptions& options) {
  Json out;
  try {
    solve(c, c.reference(), options, out);
  } catch (const InputError& error) {
    out = {{"exit_code", refused}, {"note", error.what()}};
  } catch (const std::exception& error) {
    out = {{"exit_code", failed}, {"note", error.what()}};
  }
  return out.dump();
}

double number(const Json& json, const char* key) {
  return json.contains(key) ? std::stod(json[key].get<std::string>()) : nan;
}

}  // namespace

void make_mesh(const BarsCase& c) {
  if (!c.make_mesh) return;
  run_in_child([&] {  // measured processes would inherit the mesh's memory
    try {
      c.make_mesh();
    } catch (const std::exception& error) {
      fmt::print(stderr, "bars: {}\n", error.what());
    }
    return std::string();
  });
}

Measured measure(const BarsCase& c, const std::string& method, const RunOptions& options) {
  Measured m;
  m.case_name = c.name;
  m.method = method;
  m.bar = c.bar;
  RunOptions all = options;
  all.quiet = true;
  all.overrides = c.overrides;
  all.overrides.push_back("solver.method=" + method);
  all.overrides.insert(all.overrides.end(), options.overrides.begin(), options.overrides.end());
  for (const std::string& setting : options.overrides)
    m.setting += (m.setting.empty() ? "" : " ") + setting;

  const ChildResult child = run_in_child([&] { return work(c, all); });
  const Json json = child.signal == 0
                        ? Json::parse(child.output)
                        : Json{{"exit_code", -child.signal}, {"note", "killed by a signal"}};
  m.chosen = json.value("chosen", "");
  m.source = json.value("source", "");
  m.note = json.value("note", "");
  m.exit_code = json.at("exit_code").get<int>();
  m.triangles = number(json, "triangles");
  m.l2_error = number(json, "l2_error");
  m.largest_error = number(json, "largest_error");
  m.error_estimate = number(json, "error_estimate");
  m.numerical_error = number(json, "numerical_error");
  m.noise = number(json, "noise");
  m.energy_imbalance = number(json, "energy_imbalance");
  m.seconds = number(json, "seconds");
  m.cpu_seconds = number(json, "cpu_seconds");
  if (json.contains("stages")) m.stages = json["stages"].get<decltype(m.stages)>();
  m.peak_mib = child.peak_mib;
  return m;
}

std::vector<std::string> table_header() {
  return {"case",
          "method",
          "chosen",
          "source",
          "settings",
          "triangles",
          "bar",
          "relative_l2_error",
          "largest_error",
          "error_estimate",
          "numerical_error",
          "noise",
          "energy_imbalance",
          "exit_code",
          "seconds",
          "cpu_seconds",
          "peak_mib",
          "seconds_by_stage",
          "note"};
}

std::vector<std::string> table_row(const Measured& m) {
  std::string stages;
  for (const auto& [name, seconds] : m.stages)
    stages += fmt::format("{}{} {:.3f}", stages.empty() ? "" : "; ", name, seconds);
  const auto figure = [](double value) { return fmt::format("{:.4g}", value); };
  return {m.case_name,
          m.method,
          m.chosen,
          m.source,
          m.setting,
          fmt::format("{:.0f}", m.triangles),
          figure(m.bar),
          figure(m.l2_error),
          figure(m.largest_error),
          figure(m.error_estimate),
          figure(m.numerical_error),
          figure(m.noise),
          figure(m.energy_imbalance),
          std::to_string(m.exit_code),
          fmt::format("{:.2f}", m.seconds),
          fmt::format("{:.2f}", m.cpu_seconds),
          fmt::format("{:.0f}", m.peak_mib),
          stages,
          m.note};
}

std::string heading() {
  return fmt::format("{:<18}{:<12}{:<12}{:>10}{:>8}{:>9}{:>9}{:>9}{:>5}{:>8}{:>8}{:>8}  {}", "case",
                     "method", "chosen", "triangles", "bar", "L2", "max", "estimate", "exit",
                     "seconds", "cpu s", "MiB", "note");
}

std::string line(const Measured& m) {
  return fmt::format(
      "{:<18}{:<12}{:<12}{:>10.0f}{:>8.3g}{:>9.2g}{:>9.2g}{:>9.2g}{:>5}{:>8.2f}{:>8.2f}{:>8.0f}  "
      "{} {}",
      m.case_name, m.method, m.chosen, m.triangles, m.bar, m.l2_error, m.largest_error,
      m.error_estimate, m.exit_code, m.seconds, m.cpu_seconds, m.peak_mib, m.setting, m.note);
}

}  // namespace knotlight
