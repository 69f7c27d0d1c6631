#include "detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>

#include "child.h"
#include "meshes.h"

namespace knotlight {
namespace {

constexpr std::size_t fewest_triangles = 1000;

// In a child too: the next one would inherit the mesh's memory. Returns the number of triangles in
// the file; the scene reader may halve long edges after.
std::size_t make_mesh(const std::string& path, const std::function<TriangleMesh()>& make) {
  const ChildResult made = run_in_child([&] {
    const TriangleMesh mesh = make();
    write_ply(path, mesh);
    return std::to_string(mesh.triangles.size());
  });
  if (made.output.empty()) throw std::runtime_error("cannot make " + path);
  return std::stoul(made.output);
}

}  // namespace

std::vector<Measured> measure_detail(const std::vector<std::string>& methods, std::size_t most,
                                     const RunOptions& options) {
  const std::vector<BarsCase> cases = bars_cases();
  const BarsCase bumpy = *std::find_if(cases.begin(), cases.end(),
                                       [](const BarsCase& c) { return c.name == "bumpy"; });
  std::vector<Measured> results;
  for (const bool same_surface : {true, false}) {
    for (std::size_t triangles = fewest_triangles; triangles <= most; triangles *= 2) {
      BarsCase c = bumpy;
      c.name = same_surface ? "bumpy" : "rippled";
      const std::string path = made_mesh(fmt::format("{}-{}", c.name, triangles));
      const std::size_t made = make_mesh(path, [&] {
        return same_surface ? refined_to(bumpy_mesh(), triangles) : rippled_mesh(triangles);
      });
      c.overrides.push_back("objects.bumpy.mesh=" + path);
      for (const std::string& method : methods) {
        Measured m = measure(c, method, options);
        m.triangles = static_cast<double>(made);
        if (!same_surface) m.l2_error = m.largest_error = m.bar = std::nan("");
        fmt::print("{}\n", line(m));
        std::fflush(stdout);
        results.push_back(std::move(m));
      }
    }
  }
  return results;
}

}  // namespace knotlight
