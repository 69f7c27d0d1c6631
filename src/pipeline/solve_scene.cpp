#include "pipeline/solve_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/beyond_p1.h"
#include "pipeline/grid_load.h"
#include "pipeline/photon_budget.h"
#include "pipeline/plan.h"
#include "pipeline/solve_grid.h"
#include "scene/refracts.h"
#include "trace/overlap.h"

namespace knotlight {

namespace {

// Photons are sent at the sphere around all translucent objects. Whether enough of them were aimed
// at one object's own sphere to tell darkness from bad luck.
bool aimed_at(const PreparedScene& prepared, std::uint32_t object) {
  constexpr double enough = 10'000.0;  // three in so many is the 95 % bound if none was seen
  Bounds all;
  for (const std::uint32_t i : prepared.translucent) {
    const Bounds own = bounds(prepared.scene.objects[i].shape);
    all.extend(own.lo);
    all.extend(own.hi);
  }
  const double share =
      std::pow(bounds(prepared.scene.objects[object].shape).radius() / all.radius(), 2);
  return prepared.scene.lights.empty() ||
         share * static_cast<double>(prepared.scene.solver.photons) >= enough;
}

// Lights that stand, or partly stand, inside a translucent object.
std::vector<std::string> lamps_inside(const PreparedScene& prepared) {
  std::vector<std::string> lamps;
  for (std::size_t l = 0; l < prepared.scene.lights.size(); ++l) {
    std::vector<Vec3> places;
    const Light& light = prepared.scene.lights[l];
    if (const auto* point = std::get_if<PointLight>(&light)) places = {point->position};
    if (const auto* area = std::get_if<AreaLight>(&light))
      for (const double a : {-1.0, 0.0, 1.0})
        for (const double b : {-1.0, 0.0, 1.0})
          places.push_back(area->center + a * area->u + b * area->v);
    const bool inside = std::any_of(places.begin(), places.end(), [&](const Vec3& p) {
      return std::any_of(prepared.translucent.begin(), prepared.translucent.end(),
                         [&](std::uint32_t object) { return prepared.caster->inside(p, object); });
    });
    if (inside) lamps.push_back(fmt::format("lights.{}", l));
  }
  return lamps;
}

// The grids of an object, all its channels share them.
ObjectGrids kept_grids(std::uint32_t index, const Object& object, const Scene& scene,
                       const RunContext& run, FactorCache& factors) {
  const FactorCache::Key key{index, Method::automatic, 0.0, 0.0};  // no method's own
  auto grids = factors.find<ObjectGrids>(key);
  if (!grids) {
    grids = std::make_shared<const ObjectGrids>(
        make_grids(object, scene.channels, scene.solver, run.workers));
    factors.put(key, grids);
  }
  return *grids;
}

bool scatters_anisotropically(const PreparedScene& prepared) {
  return std::any_of(prepared.translucent.begin(), prepared.translucent.end(),
                     [&](std::uint32_t object) {
                       return (prepared.scene.objects[object].translucent()->g != 0.0).any();
                     });
}

// Whether the number of photons was left open, and nothing looks at them but the solver, which
// evens out their noise: density estimates do not.
bool may_save_photons(const PreparedScene& prepared, const Plan& plan) {
  const SolverSettings& solver = prepared.scene.solver;
  if (!solver.photons_at_most || plan.source != SourceModel::photon_map) return false;
  for (std::size_t i = 0; i < plan.methods.size(); ++i) {
    const double ior = prepared.scene.objects[prepared.translucent[i]].translucent()->ior;
    if (plan.methods[i].method == Method::bkm_thesis || (solver.diffusion && ior != 1.0))
      return false;
  }
  return true;
}

}  // namespace

std::optional<PreparedScene> similar_scene(const PreparedScene& prepared) {
  if (!solves_beyond_p1(prepared.scene.solver) || !scatters_anisotropically(prepared))
    return std::nullopt;
  Scene similar = prepared.scene;
  similar.solver.similarity = true;
  return prepare_scene(std::move(similar));
}

SolvedScene solve_scene(const PreparedScene& prepared, RunContext& run, bool keep_light) {
  FactorCache factors;
  return solve_scene(prepared, run, factors, keep_light);
}

SolvedScene solve_scene(const PreparedScene& prepared, RunContext& run, FactorCache& factors,
                        bool keep_light) {
  if (const auto similar = similar_scene(prepared))
    return solve_scene(*similar, run, factors, keep_light);
  const Plan plan = make_plan(prepared);
  if (may_save_photons(prepared, plan)) {
    const std::size_t most = prepared.scene.solver.photons;
    Scene fewer = prepared.scene;
    fewer.solver.photons_at_most = false;
    fewer.solver.photons = first_photons(most);
    while (true) {  // the systems are factored once
      SolvedScene tried = solve_scene(prepare_scene(fewer), run, factors, keep_light);
      const std::size_t needed =
          photons_needed(tried.report, fewer.solver.photons, most, fewer.solver.tolerance);
      if (needed <= fewer.solver.photons) return tried;
      fewer.solver.photons = needed;
    }
  }
  const Scene& scene = prepared.scene;
  const auto channels = static_cast<std::size_t>(scene.channels);

  std::vector<std::vector<IncidentLight>> light;  // [channel][translucent object]
  {
    Stage stage(run.stages, "photons", incident_light_work(prepared, plan.source) * channels);
    for (int c = 0; c < scene.channels; ++c)
      light.push_back(
          trace_incident_light(prepared, c, plan.source, run.options.seed, run.workers, stage));
  }

  std::vector<std::optional<ObjectGrids>> grids(prepared.translucent.size());
  const auto on_grid = [&](std::size_t i) { return plan.methods[i].method == Method::grid; };
  // Pictures need it where light is refracted on its way in (render/gather.h).
  const auto wants_U_ri = [&](std::size_t i) {
    return scene.solver.diffusion && plan.source == SourceModel::photon_map &&
           scene.objects[prepared.translucent[i]].translucent()->ior != 1.0;
  };
  {
    Stage stage(run.stages, "grid", grids.size());
    for (std::size_t i = 0; i < grids.size(); ++i) {
      if (on_grid(i) || wants_U_ri(i))
        grids[i] = kept_grids(prepared.translucent[i], scene.objects[prepared.translucent[i]],
                              scene, run, factors);
      stage.advance();
    }
  }

  std::vector<std::optional<FeltSurface>> surface(prepared.translucent.size());
  if (solves_beyond_p1(scene.solver))
    for (std::size_t i = 0; i < surface.size(); ++i)
      surface[i] = felt_surface(scene.objects[prepared.translucent[i]], scene.channels);

  // Every (object, channel) is a system of its own. Those of methods that use several threads
  // within one run one after the other; then the others side by side.
  const std::size_t systems = prepared.translucent.size() * channels;
  std::vector<std::optional<SolvedChannel>> solved(systems);
  {
    Stage stage(run.stages, "solve", systems);
    const auto solve = [&](std::size_t system, const Workers& workers) {
      const std::size_t i = system / channels;
      const std::size_t channel = system % channels;
      const Medium medium =
          scene.objects[prepared.translucent[i]].translucent()->medium(static_cast<int>(channel));
      IncidentLight& incident = light[channel][i];
      const double photon_power = incident.photon_power();
      std::optional<GridField> U_ri;
      if (wants_U_ri(i) && grids[i]->fine->ok())
        U_ri = unscattered_on_grid(grids[i]->fine, incident, medium);
      const Equation equation =
          equation_for(scene, prepared.translucent[i], static_cast<int>(channel), plan.source,
                       surface[i] ? &*surface[i] : nullptr);
      if (equation.beyond_p1) weigh_sources(incident, medium, equation, *surface[i]);
      solved[system] =
          solve_channel(scene, *prepared.caster, prepared.translucent[i], static_cast<int>(channel),
                        equation, plan.methods[i].method, on_grid(i) ? &*grids[i] : nullptr,
                        incident, run.options.seed, workers, factors);
      // Gathered light is taken as isotropic: with P1 and g != 0 that is the similar medium.
      solved[system]->scattering = medium.similar();
      solved[system]->U_ri = std::move(U_ri);
      solved[system]->report.photon_power = photon_power;
      if (!keep_light) light[channel][i] = {};  // freed as we go
      stage.advance();
    };
    std::vector<std::size_t> single;
    for (std::size_t system = 0; system < systems; ++system)
      if (on_grid(system / channels))
        single.push_back(system);
      else
        solve(system, run.workers);
    run.workers.for_chunks(single.size(), 1, [&](std::size_t, std::size_t begin, std::size_t) {
      solve(single[begin], Workers(1));
    });
  }

  SolvedScene result;
  result.plan = plan;
  if (plan.source == SourceModel::photon_map) result.report.photons_emitted = scene.solver.photons;
  if (keep_light) result.light = std::move(light);
  if (plan.source != SourceModel::photon_map)
    for (const std::string& lamp : lamps_inside(prepared))
      result.report.failures.push_back(
          fmt::format("{} lies inside a translucent object: {} counts light from outside alone",
                      lamp, name_of(plan.source)));
  const bool refracts = anything_refracts(scene);
  if (plan.source != SourceModel::photon_map &&
      (prepared.translucent.size() > 1 || (refracts && light_can_come_back(prepared))))
    result.report.failures.push_back(
        fmt::format("{} does not follow unscattered light that one surface throws on another or "
                    "one object lets through to another",
                    name_of(plan.source)));
  if (plan.source != SourceModel::photon_map && refracts && scene.solver.diffusion)
    result.report.failures.push_back(fmt::format(
        "{} does not tell what a gathered picture needs of light inside refracting objects, "
        "expected source photon_map or another exitance",
        name_of(plan.source)));
  for (const std::string& inclusion : opaque_inclusions(scene, *prepared.caster))
    result.report.failures.push_back(inclusion + ": the diffusion equation does not know it");
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const Object& object = scene.objects[prepared.translucent[i]];
    ObjectReport report;
    report.name = object.name;
    report.source = plan.source_reason;
    report.method = plan.methods[i].reason;
    result.objects.emplace_back();
    for (std::size_t c = 0; c < channels; ++c) {
      SolvedChannel& channel = *solved[i * channels + c];
      const std::string where = channels == 1
                                    ? fmt::format("object '{}'", object.name)
                                    : fmt::format("object '{}', channel {}", object.name, c);
      const Validity validity =
          diffusion_validity(object.shape, object.translucent()->medium(static_cast<int>(c)));
      for (const std::string& failure : channel.failures)
        result.report.failures.push_back(fmt::format("{}: {}", where, failure));
      if (plan.source == SourceModel::photon_map && channel.report.photons == 0 &&
          !aimed_at(prepared, prepared.translucent[i]))
        result.report.failures.push_back(fmt::format(
            "{}: no photon met it, but hardly any was sent its way: it is small beside the others",
            where));
      for (const std::string& reason : validity.reasons)
        result.report.failures.push_back(
            fmt::format("{}: diffusion does not hold: {}", where, reason));
      report.validity.push_back(validity);
      report.channels.push_back(channel.report);
      result.objects.back().push_back(std::move(channel));
    }
    result.report.objects.push_back(report);
  }
  return result;
}

}  // namespace knotlight
