#include "study/study.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "scene/nearest_name.h"
#include "study/experiments.h"
#include "study/lit_body.h"

namespace knotlight {

const std::vector<Study>& studies() {
  static const std::vector<Study> all{
      manufactured_study(), precision_study(),   layouts_study(),           singular_values_study(),
      svd_drivers_study(),  oscillation_study(), radial_functions_study(),  interior_points_study(),
      knots_study(),        scaling_study(),     inversion_study(),         models_study(),
      rescaling_study(),    flat_limit_study(),  boundary_particle_study(), heterogeneous_study()};
  return all;
}

std::vector<Study> chosen_studies(const std::string& name) {
  if (name == "all") return studies();
  std::vector<std::string> names;
  for (const Study& study : studies()) {
    if (study.name == name) return {study};
    names.push_back(study.name);
  }
  names.emplace_back("all");
  throw InputError(fmt::format("{}: no such study, expected {}{}", name, one_of(names),
                               did_you_mean(name, names)));
}

std::vector<StudyResult> run_studies(const std::vector<Study>& chosen, const StudyOptions& options,
                                     RunContext& run) {
  for (const Study& study : chosen)
    for (const std::string& file : study.needs)
      if (!std::filesystem::exists(options.scenes / file))
        throw InputError(
            fmt::format("{}: no such file, expected study {} to be called from the top folder "
                        "of the repository",
                        (options.scenes / file).string(), study.name));
  LitBodies bodies(options.quick, run);
  StudyBench bench{options, run, bodies};
  std::vector<StudyResult> results;
  for (const Study& study : chosen) {
    const Stage stage(run.stages, study.name, 1);
    results.push_back({study, study.run(bench)});
  }
  return results;
}

}  // namespace knotlight
