#include "pipeline/probe_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/errors.h"
#include "core/file_io.h"
#include "pipeline/incident_light.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"

namespace knotlight {
namespace {

constexpr double surface_slack = 1e-3;  // of the object's size: fixed by the command's contract
constexpr std::size_t probes_per_chunk = 64;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  std::string field;
  while (std::getline(stream, field, ',')) fields.push_back(trimmed(field));
  return fields;
}

std::size_t column_of(const std::vector<std::string>& header, const std::string& name,
                      const std::string& path) {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end())
    throw InputError(
        fmt::format("{}:1: {}: no such column, expected a header with x, y, z", path, name));
  return static_cast<std::size_t>(found - header.begin());
}

double number(const std::vector<std::string>& fields, std::size_t column, const char* name,
              const std::string& path, std::size_t line) {
  const std::string text = column < fields.size() ? fields[column] : "";
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw InputError(fmt::format("{}:{}: {}: '{}' is not a finite number, expected one", path, line,
                                 name, text));
  return value;
}

std::vector<Vec3> read_points(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  if (!in || !std::getline(in, line))
    throw InputError(
        fmt::format("{}:1: points: cannot read, expected a CSV file with a header x,y,z", path));
  const std::vector<std::string> header = split(line);
  const std::size_t x = column_of(header, "x", path);
  const std::size_t y = column_of(header, "y", path);
  const std::size_t z = column_of(header, "z", path);
  std::vector<Vec3> points;
  for (std::size_t row = 2; std::getline(in, line); ++row) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> fields = split(line);
    points.emplace_back(number(fields, x, "x", path, row), number(fields, y, "y", path, row),
                        number(fields, z, "z", path, row));
  }
  return points;
}

// Photon maps that tell U_ri, [channel][translucent object]: from the light of the solution, or of
// their own where that has no photons.
std::vector<std::vector<VolumePhotonMap>> first_light_maps(const PreparedScene& prepared,
                                                           SolvedScene& solved, RunContext& run) {
  const Scene& scene = prepared.scene;
  const auto channels = static_cast<std::size_t>(scene.channels);
  std::vector<std::vector<VolumePhotonMap>> maps(channels);
  const bool traced = solved.plan.source == SourceModel::photon_map;
  Stage stage(
      run.stages, "photon map",
      traced ? channels : incident_light_work(prepared, SourceModel::photon_map) * channels);
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<IncidentLight> light =
        traced ? std::move(solved.light[c])
               : trace_incident_light(prepared, static_cast<int>(c), SourceModel::photon_map,
                                      run.options.seed, run.workers, stage);
    for (std::size_t i = 0; i < light.size(); ++i) {
      // Both halves in one map: each is an estimate of all the light.
      std::vector<VolumePhoton> photons = std::move(light[i].halves[0].photons);
      photons.insert(photons.end(), light[i].halves[1].photons.begin(),
                     light[i].halves[1].photons.end());
      for (VolumePhoton& photon : photons) photon.power *= 0.5;
      const Object& object = scene.objects[prepared.translucent[i]];
      maps[c].emplace_back(std::move(photons), object.translucent()->medium(static_cast<int>(c)));
    }
    if (traced) stage.advance();
  }
  return maps;
}

// Where a point lies: in or on a translucent object, and the place to evaluate there.
struct Place {
  std::size_t object;  // in SolvedScene::objects
  Vec3 point;
};

std::optional<Place> locate(const Vec3& p, const PreparedScene& prepared) {
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i)
    if (prepared.caster->inside(p, prepared.translucent[i])) return Place{i, p};
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const std::uint32_t object = prepared.translucent[i];
    const Vec3 nearest = prepared.caster->nearest_surface_point(p, object).position;
    const double size = bounds(prepared.scene.objects[object].shape).largest_extent();
    if ((nearest - p).norm() <= surface_slack * size) return Place{i, nearest};
  }
  return std::nullopt;
}

}  // namespace

Report probe_scene(const std::string& path, const std::string& points_csv,
                   const std::string& output_csv, RunContext& run, Scene& scene_out) {
  const std::vector<Vec3> points = read_points(points_csv);
  PreparedScene prepared = prepare_scene(path, run);
  // Beyond P1 the solution is only a part of U_d, which pictures complete while they gather.
  prepared.scene.solver.diffusion.reset();
  prepared.scene.solver.photons_at_most = false;  // U_ri at single points wants all of them
  SolvedScene solved = solve_scene(prepared, run, true);
  const auto maps = first_light_maps(prepared, solved, run);
  if (solved.plan.source != SourceModel::photon_map && !enough_photons(prepared.scene))
    solved.report.failures.push_back(too_few_photons(prepared.scene));

  std::vector<std::string> rows(points.size());
  {
    Stage stage(run.stages, "probe", points.size());
    run.workers.for_chunks(
        points.size(), probes_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            const Vec3& p = points[i];
            const auto place = locate(p, prepared);
            std::string row = fmt::format("{},{},{}", p.x(), p.y(), p.z());
            for (int c = 0; c < prepared.scene.channels; ++c) {
              if (!place) {
                row += ",nan,nan";
                continue;
              }
              const SolvedChannel& channel =
                  solved.objects[place->object][static_cast<std::size_t>(c)];
              const VolumePhotonMap& map = maps[static_cast<std::size_t>(c)][place->object];
              const double U_ri =
                  map.estimate(place->point,
                               estimate_options(
                                   prepared.scene.solver, map.size(),
                                   prepared.scene.objects[prepared.translucent[place->object]]
                                       .translucent()
                                       ->medium(c)),
                               *prepared.caster, prepared.translucent[place->object])
                      .U_ri;
              // This model solves for both together.
              const double in_U_d = channel.model == SourceModel::boundary_flux ? U_ri : 0.0;
              row += fmt::format(",{},{}", channel.U_d_at(place->point) - in_U_d, U_ri);
            }
            rows[i] = row + (place ? ",ok\n" : ",outside\n");
          }
          stage.advance(end - begin);
        });
  }
  std::string text = "x,y,z";
  for (int c = 0; c < prepared.scene.channels; ++c) text += fmt::format(",U_d.{0},U_ri.{0}", c);
  text += ",status\n";
  for (const std::string& row : rows) text += row;
  write_text_file(output_csv, text);
  scene_out = prepared.scene;
  return solved.report;
}

}  // namespace knotlight
