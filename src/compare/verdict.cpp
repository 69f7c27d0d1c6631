#include "compare/verdict.h"

#include <fmt/format.h>

#include <cmath>

namespace knotlight {
namespace {

// A difference in time below this share of the whole is within what runs vary by.
constexpr double same_time = 0.1;

std::string time_against(double seconds, double others) {
  const double saved = others - seconds;
  if (std::abs(saved) <= same_time * others) return "takes as long";
  return fmt::format("{} {:.2g} s ({:.0f} %)", saved > 0.0 ? "saves" : "costs another",
                     std::abs(saved), 100.0 * std::abs(saved) / others);
}

std::string sentence(const ComparedModel& model, const ComparedModel* photon_map) {
  const std::string name = name_of(model.run.model);
  if (!model.run.ran()) return fmt::format("{} cannot be run here: {}.", name, model.run.cannot);
  if (!std::isfinite(model.errors.surface)) return name + " came to no solution.";
  if (photon_map == nullptr || photon_map == &model)
    return fmt::format("{} comes within {} of the converged solution on the surface, in {:.2g} s.",
                       name, percent(model.errors.surface), model.run.cost.solution());
  return fmt::format("{} {} and is {} off on the surface, {} in the picture.", name,
                     time_against(model.run.cost.solution(), photon_map->run.cost.solution()),
                     percent(model.errors.surface), percent(model.errors.picture));
}

// The quickest of those with an error on the surface of at most `allowed`; null if none.
const ComparedModel* quickest_within(const Comparison& c, double allowed) {
  const ComparedModel* best = nullptr;
  for (const ComparedModel& model : c.models)
    if (model.run.ran() && model.errors.surface <= allowed &&
        (best == nullptr || model.run.cost.solution() < best->run.cost.solution()))
      best = &model;
  return best;
}

std::string choice(const Comparison& c) {
  // The scene's tolerance is for one error; light and solve each have one.
  const double allowed = 2.0 * c.tolerance;
  const ComparedModel* best = quickest_within(c, allowed);
  std::string text = best != nullptr
                         ? fmt::format(
                               "To stay within {} of the diffusion solution, twice the "
                               "scene's tolerance, take {}.",
                               percent(allowed), name_of(best->run.model))
                         : fmt::format(
                               "None stays within {} of the diffusion solution, twice the "
                               "scene's tolerance.",
                               percent(allowed));
  const double p1 = c.diffusion_itself.transport;
  if (!c.no_truth.empty() || !(p1 > allowed)) return text;
  const ComparedModel* enough = quickest_within(c, p1);
  if (enough != nullptr && enough != best)
    text += fmt::format(
        " But diffusion itself is {} off from the photons inside the object: measured by that, {} "
        "is "
        "good enough for what is seen from outside.",
        percent(p1), name_of(enough->run.model));
  return text;
}

}  // namespace

std::string percent(double share) {
  if (!std::isfinite(share)) return "unknown";
  const double hundredths = 100.0 * share;
  // Two digits; from ten on whole numbers, else 120 would read 1.2e+02.
  return std::abs(hundredths) < 10.0 ? fmt::format("{:.2g} %", hundredths)
                                     : fmt::format("{:.0f} %", hundredths);
}

std::vector<std::string> verdict(const Comparison& c) {
  std::vector<std::string> sentences;
  if (c.no_truth.empty())
    sentences.push_back(
        fmt::format("Solved to convergence, diffusion is {} off from photons of all orders inside "
                    "the object; no source model can be expected to do much better.",
                    percent(c.diffusion_itself.transport)));
  const ComparedModel* photon_map = nullptr;
  for (const ComparedModel& model : c.models)
    if (model.run.model == SourceModel::photon_map && model.run.ran() &&
        std::isfinite(model.errors.surface))
      photon_map = &model;
  for (const ComparedModel& model : c.models) sentences.push_back(sentence(model, photon_map));
  sentences.push_back(choice(c));
  return sentences;
}

}  // namespace knotlight
