#include "pipeline/render_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/image_io.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "render/picture.h"

namespace knotlight {
namespace {

constexpr std::size_t nodes_per_chunk = 512;

Exitance chosen_exitance(const SolverSettings& settings) {
  return settings.exitance.value_or(Exitance::p1);
}

const char* name_of(Exitance exitance) {
  switch (exitance) {
    case Exitance::p1:
      return "p1";
    case Exitance::lambert:
      return "lambert";
    case Exitance::mean_intensity:
      return "mean_intensity";
    case Exitance::gather:
      return "gather";
  }
  return "";
}

// What a picture file says about itself.
Metadata picture_metadata(const Scene& scene, const std::string& path, const Report& report,
                          const RunContext& run) {
  Metadata metadata = {
      {"Software", "knotlight " KNOTLIGHT_VERSION},
      {"knotlight:scene", path},
      {"knotlight:units", fmt::format("radiance in W/({0}^2 sr)", scene.units)},
      {"knotlight:exitance", name_of(chosen_exitance(scene.solver))},
      {"knotlight:boundary", scene.solver.boundary == Boundary::milne ? "milne" : "marshak"},
      {"knotlight:photons", fmt::format("{}", scene.solver.photons)},
      {"knotlight:tolerance", fmt::format("{}", scene.solver.tolerance)},
      {"knotlight:seed", fmt::format("{}", run.options.seed)},
      {"knotlight:trusted", report.failures.empty() ? "yes" : "no"}};
  for (const ObjectReport& object : report.objects)
    metadata.emplace_back("knotlight:method:" + object.name, object.method);
  for (const std::string& item : run.options.overrides)
    metadata.emplace_back("knotlight:set", item);
  if (!report.failures.empty())
    metadata.emplace_back("knotlight:failures",
                          fmt::format("{}", fmt::join(report.failures, "; ")));
  return metadata;
}

}  // namespace

GlowingSurfaces glowing_surfaces(const PreparedScene& prepared, const SolvedScene& solved,
                                 RunContext& run) {
  const Scene& scene = prepared.scene;
  GlowingSurfaces surfaces(scene.objects.size());
  std::size_t total = 0;
  for (const std::uint32_t index : prepared.translucent) {
    surfaces[index].emplace(GlowingSurface{SurfaceGrid(scene.objects[index].shape),
                                           {},
                                           {},
                                           solved.plan.source == SourceModel::boundary_flux});
    total += static_cast<std::size_t>(surfaces[index]->grid.nodes().cols() * scene.channels);
  }
  Stage stage(run.stages, "surface", total);
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const std::uint32_t index = prepared.translucent[i];
    GlowingSurface& surface = *surfaces[index];
    const Points& nodes = surface.grid.nodes();
    for (int c = 0; c < scene.channels; ++c) {
      const SolvedChannel& solution = solved.objects[i][static_cast<std::size_t>(c)];
      Eigen::VectorXd values = Eigen::VectorXd::Zero(nodes.cols());
      // The picture is written all the same, marked as not to be trusted: what could not be solved
      // stays dark in it.
      if (solution.solved)
        run.workers.for_chunks(static_cast<std::size_t>(nodes.cols()), nodes_per_chunk,
                               [&](std::size_t, std::size_t begin, std::size_t end) {
                                 const auto first = static_cast<Eigen::Index>(begin);
                                 const auto count = static_cast<Eigen::Index>(end - begin);
                                 values.segment(first, count) =
                                     solution.U_d(nodes.middleCols(first, count));
                                 stage.advance(end - begin);
                               });
      surface.U_d.push_back(std::move(values));
      surface.leaving.emplace_back(scene.objects[index].translucent()->medium(c),
                                   scene.solver.boundary, chosen_exitance(scene.solver));
    }
  }
  return surfaces;
}

Image take_picture(const PreparedScene& prepared, const SolvedScene& solved, RunContext& run) {
  const GlowingSurfaces surfaces = glowing_surfaces(prepared, solved, run);
  const Shading shading(prepared.scene, *prepared.caster, surfaces);
  Stage stage(run.stages, "picture", picture_tiles(prepared.scene.camera));
  return render_picture(prepared.scene.camera, shading, run.options.seed, run.workers, stage);
}

Report render_scene(const std::string& path, const std::vector<std::string>& outputs,
                    RunContext& run, Scene& scene_out) {
  const PreparedScene prepared = prepare_scene(path, run);
  const SolvedScene solved = solve_scene(prepared, run);
  const Image image = take_picture(prepared, solved, run);
  const Stage stage(run.stages, "write", 0);
  for (const std::string& output : outputs)
    write_image(output, image, picture_metadata(prepared.scene, path, solved.report, run));
  scene_out = prepared.scene;
  return solved.report;
}

}  // namespace knotlight
