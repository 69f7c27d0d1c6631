#include "pipeline/report_json.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace knotlight {
namespace {

using Json = nlohmann::ordered_json;

// One value per channel: a number alone, or a list of three.
template <typename T>
Json per_channel(const std::vector<T>& items, const std::function<Json(const T&)>& value) {
  if (items.size() == 1) return value(items.front());
  Json list = Json::array();
  for (const T& item : items) list.push_back(value(item));
  return list;
}

void add_validity(Json& json, const std::vector<Validity>& v) {
  json["lambda_R"] = per_channel<Validity>(v, [](auto& x) { return x.lambda_R; });
  json["reduced_albedo"] = per_channel<Validity>(v, [](auto& x) { return x.reduced_albedo; });
  json["size_in_mean_free_paths"] =
      per_channel<Validity>(v, [](auto& x) { return x.size_in_mean_free_paths; });
  json["thickness_in_transport_mean_free_paths"] =
      per_channel<Validity>(v, [](auto& x) { return x.thickness; });
  bool valid = true;
  Json reasons = Json::array();
  for (const Validity& channel : v) {
    valid = valid && channel.valid;
    for (const std::string& reason : channel.reasons) reasons.push_back(reason);
  }
  json["valid"] = valid;
  json["reasons"] = reasons;
}

void add_audit(Json& json, const std::vector<EnergyAudit>& audit) {
  using A = EnergyAudit;
  json["incident_power"] = per_channel<A>(audit, [](auto& a) { return a.incident; });
  json["reflected_fraction"] =
      per_channel<A>(audit, [](auto& a) { return a.reflected_fraction(); });
  json["absorbed_fraction"] = per_channel<A>(audit, [](auto& a) { return a.absorbed_fraction(); });
  json["escaped_fraction"] = per_channel<A>(audit, [](auto& a) { return a.escaped_fraction(); });
  json["lost_fraction"] = per_channel<A>(audit, [](auto& a) { return a.lost / a.incident; });
  json["standard_error"] = per_channel<A>(audit, [](auto& a) {
    return std::max(a.standard_error_absorbed, a.standard_error_escaped) / a.incident;
  });
  json["audit_photons"] = per_channel<A>(audit, [](auto& a) { return a.photons; });
}

void add_solution(Json& json, const std::vector<ChannelReport>& channels) {
  using C = ChannelReport;
  const auto add = [&](const char* key, const std::function<Json(const C&)>& value) {
    json[key] = per_channel<C>(channels, value);
  };
  add("lambda", [](auto& c) { return c.lambda; });
  add("k", [](auto& c) { return c.k; });
  add("photons", [](auto& c) { return c.photons; });
  add("photon_power", [](auto& c) { return c.photon_power; });
  add("entered_power", [](auto& c) { return c.entered_power; });
  add("methods", [](auto& c) { return c.method; });
  // Channels may have been solved by different methods: what one of them does not tell is null.
  for (const C& channel : channels)
    for (const auto& figure : channel.figures) {
      const std::string& name = figure.first;
      if (json.contains(name)) continue;
      add(name.c_str(), [&name](const C& c) -> Json {
        for (const auto& [key, value] : c.figures)
          if (key == name) return value;
        return nullptr;
      });
    }
  add("numerical_error", [](auto& c) { return c.numerical_error; });
  add("noise", [](auto& c) { return c.noise; });
  add("error_estimate", [](auto& c) { return c.error_estimate; });
  add("energy_imbalance", [](auto& c) { return c.energy_imbalance; });
  add("energy_imbalance_standard_error", [](auto& c) { return c.energy_imbalance_standard_error; });
  add("power_in", [](auto& c) { return c.power_in; });
  add("power_leaving", [](auto& c) { return c.power_leaving; });
  add("power_absorbed", [](auto& c) { return c.power_absorbed; });
}

}  // namespace

std::string report_json(const std::string& command, const Report& report, const Scene& scene,
                        const RunContext& run) {
  Json json;
  json["program"] = "knotlight " KNOTLIGHT_VERSION;
  json["command"] = command;
  json["units"] = scene.units;
  json["channels"] = scene.channels;
  json["seed"] = run.options.seed;
  json["threads"] = run.workers.threads();
  json["photons_emitted"] = report.photons_emitted;
  json["tolerance"] = scene.solver.tolerance;
  json["objects"] = Json::array();
  double worst = 0.0;
  bool solved = false;
  for (const ObjectReport& object : report.objects) {
    Json entry;
    entry["name"] = object.name;
    entry["source"] = object.source;
    entry["method"] = object.method;
    add_validity(entry, object.validity);
    if (!object.audit.empty()) add_audit(entry, object.audit);
    if (!object.channels.empty()) add_solution(entry, object.channels);
    for (const ChannelReport& channel : object.channels) {
      solved = true;
      // Not-a-number must win the comparison, not lose it.
      if (std::isnan(channel.error_estimate) || channel.error_estimate > worst)
        worst = std::isnan(worst) ? worst : channel.error_estimate;
    }
    json["objects"].push_back(entry);
  }
  if (solved) {
    json["error_estimate"] = worst;
    json["trusted"] = report.failures.empty();
    json["failures"] = report.failures;
  }
  Json seconds;
  for (const auto& [name, value] : run.stages.seconds()) seconds[name] = value;
  json["seconds"] = seconds;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  json["peak_memory_MiB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return json.dump(2) + "\n";
}

}  // namespace knotlight
