#include "validate/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/errors.h"
#include "scene/nearest_name.h"
#include "validate/cases.h"

namespace knotlight {

std::size_t Validation::judged() const {
  std::size_t count = 0;
  for (const ValidatedCase& c : cases)
    count += static_cast<std::size_t>(
        std::count_if(c.rows.begin(), c.rows.end(), [](const auto& row) { return row.judged; }));
  return count;
}

std::size_t Validation::failed() const {
  std::size_t count = 0;
  for (const ValidatedCase& c : cases)
    count += static_cast<std::size_t>(
        std::count_if(c.rows.begin(), c.rows.end(), [](const auto& row) { return !row.passed(); }));
  return count;
}

// Cases run side by side, each on one thread, because a solve keeps to one thread anyway.
Validation validate(const ValidateOptions& options, RunContext& run) {
  std::vector<const ValidationCase*> chosen;
  std::vector<std::string> names;
  for (const ValidationCase& c : validation_cases()) {
    names.push_back("'" + c.name + "'");
    const bool asked_for = c.name.find(options.only) != std::string::npos;
    if (asked_for && (c.quick || !options.quick)) chosen.push_back(&c);
  }
  if (chosen.empty())
    throw InputError(fmt::format("--only {}: no case has this in its name, expected a part of {}",
                                 options.only, one_of(names)));

  Validation validation;
  validation.cases.resize(chosen.size());
  Stage stage(run.stages, "validate", chosen.size());
  run.workers.for_chunks(chosen.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    const auto start = std::chrono::steady_clock::now();
    ValidatedCase& result = validation.cases[i];
    result.name = chosen[i]->name;
    chosen[i]->run({run.options.seed}, result);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    stage.advance();
  });
  return validation;
}

}  // namespace knotlight
