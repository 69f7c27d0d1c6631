#include "pipeline/render_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/image_io.h"
#include "pipeline/layers.h"
#include "pipeline/picture_metadata.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solution_file.h"
#include "pipeline/solve_scene.h"
#include "render/picture.h"

namespace knotlight {
namespace {

Metadata render_metadata(const Scene& scene, const std::string& path, const Report& report,
                         const RunContext& run) {
  Metadata metadata = picture_metadata(scene, path, report.failures, run);
  metadata.insert(
      metadata.end(),
      {{"knotlight:exitance", name_of(chosen_exitance(scene.solver))},
       {"knotlight:boundary", scene.solver.boundary == Boundary::milne ? "milne" : "marshak"},
       {"knotlight:photons", fmt::format("{}", report.photons_emitted)},
       {"knotlight:tolerance", fmt::format("{}", scene.solver.tolerance)}});
  for (const ObjectReport& object : report.objects)
    metadata.emplace_back("knotlight:method:" + object.name, object.method);
  return metadata;
}

Image take_picture(const PreparedScene& prepared, const Shading& shading, RunContext& run,
                   PictureParts* parts = nullptr) {
  Stage stage(run.stages, "picture", picture_tiles(prepared.scene.camera));
  return render_picture(prepared.scene.camera, shading, run.options.seed, run.workers, stage,
                        parts);
}

}  // namespace

Image take_picture(const PreparedScene& prepared, const SolvedScene& solved, RunContext& run) {
  const GlowingSurfaces surfaces = glowing_surfaces(prepared, solved, run);
  return take_picture(prepared, Shading(prepared.scene, *prepared.caster, surfaces), run);
}

Report render_scene(const std::string& path, const RenderFiles& files, RunContext& run,
                    Scene& scene_out) {
  PreparedScene prepared = prepare_scene(path, run);
  choose_for_picture(prepared.scene.solver);
  const SolvedScene solved = files.solution.empty() ? solve_scene(prepared, run)
                                                    : read_solution(files.solution, prepared, run);
  const GlowingSurfaces surfaces = glowing_surfaces(prepared, solved, run);
  // Before the picture: that may take long, and be interrupted.
  if (!files.save_solution.empty()) {
    const Stage stage(run.stages, "save solution", 0);
    write_solution(files.save_solution, prepared, solved, surfaces, run);
  }
  const Shading shading(prepared.scene, *prepared.caster, surfaces);
  PictureParts parts;
  const Image image = take_picture(prepared, shading, run, files.layers.empty() ? nullptr : &parts);
  PictureLayers layers;
  if (!files.layers.empty())
    layers = picture_layers(files.layers, prepared, solved, surfaces, shading, parts, run);
  if (!run.options.quiet)
    for (const std::string& warning : layers.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const Stage stage(run.stages, "write", 0);
  const Metadata metadata = render_metadata(prepared.scene, path, solved.report, run);
  for (const std::string& picture : files.pictures) {
    if (!layers.channels.empty() && holds_layers(picture))
      write_picture_with_layers(picture, image, layers, metadata);
    else
      write_image(picture, image, metadata);
  }
  scene_out = prepared.scene;
  return solved.report;
}

}  // namespace knotlight
