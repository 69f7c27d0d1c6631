#include "rivals/dipole_picture.h"

#include "render/picture.h"
#include "render/shading.h"
#include "rivals/once_scattered.h"

namespace knotlight {

Image dipole_picture(const PreparedScene& prepared, const DipoleSettings& settings,
                     RunContext& run) {
  const Scene& scene = prepared.scene;
  const RayCaster& caster = *prepared.caster;
  GlowingSurfaces surfaces(scene.objects.size());
  {
    Stage stage(run.stages, "dipole",
                prepared.translucent.size() * static_cast<std::size_t>(scene.channels));
    for (const std::uint32_t object : prepared.translucent) {
      GlowingSurface& surface = surfaces[object].emplace(SurfaceGrid(scene.objects[object].shape));
      for (int channel = 0; channel < scene.channels; ++channel) {
        const DipoleSolution solution(scene, caster, object, channel, settings, run.options.seed,
                                      run.workers);
        surface.U_d.push_back(solution.mean_intensities(surface.grid.nodes(), run.workers));
        surface.leaving.emplace_back(scene.objects[object].translucent()->ior, solution.A(),
                                     Exitance::lambert);
        stage.advance();
      }
      if (settings.single_scattering)
        surface.once_scattered = [&scene, &caster](const Ray& ray, const Hit& hit,
                                                   const Vec3& normal, double depth_sample,
                                                   Rng& rng) {
          return once_scattered(scene, caster, ray, hit, normal, depth_sample, rng);
        };
    }
  }
  const Shading shading(scene, caster, surfaces);
  Stage stage(run.stages, "picture", picture_tiles(scene.camera));
  return render_picture(scene.camera, shading, run.options.seed, run.workers, stage);
}

}  // namespace knotlight
