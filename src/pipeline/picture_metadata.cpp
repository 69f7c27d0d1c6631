#include "pipeline/picture_metadata.h"

#include <fmt/format.h>

namespace knotlight {

Metadata picture_metadata(const Scene& scene, const std::string& path,
                          const std::vector<std::string>& failures, const RunContext& run) {
  Metadata metadata = {{"Software", "knotlight " KNOTLIGHT_VERSION},
                       {"knotlight:scene", path},
                       {"knotlight:units", fmt::format("radiance in W/({0}^2 sr)", scene.units)},
                       {"knotlight:seed", fmt::format("{}", run.options.seed)},
                       {"knotlight:trusted", failures.empty() ? "yes" : "no"}};
  for (const std::string& item : run.options.overrides)
    metadata.emplace_back("knotlight:set", item);
  if (!failures.empty())
    metadata.emplace_back("knotlight:failures", fmt::format("{}", fmt::join(failures, "; ")));
  return metadata;
}

}  // namespace knotlight
