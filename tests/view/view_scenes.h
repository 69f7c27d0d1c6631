// A small scene that solves in a tenth of a second, for the viewer's tests.
#pragma once

#include "pipeline/scene_setup.h"

namespace knotlight::test {

inline constexpr const char* ball_scene =
    R"(camera: {from: [0, -5, 1], to: [0, 0, 0], fov: 35, resolution: [32, 24], samples: 2}
lights: [{type: point, position: [3, -2, 3], intensity: 18}]
materials: {wax: {type: translucent, sigma_a: 0.2, sigma_s: 5}}
objects: [{name: ball, sphere: {radius: 1}, material: wax}]
solver: {tolerance: 0.1, photons: 30000}
)";

inline Scene ball() {
  TranslucentMaterial wax;
  wax.sigma_a = Spectrum::Constant(0.2);
  wax.sigma_s = Spectrum::Constant(5.0);
  Scene scene;
  scene.camera.from = Vec3(0, -5, 1);
  scene.camera.width_px = 32;
  scene.camera.height_px = 24;
  scene.lights = {PointLight{Vec3(3, -2, 3), Spectrum::Constant(18.0)}};
  scene.objects = {{"ball", Sphere{Vec3::Zero(), 1.0}, wax}};
  scene.solver.tolerance = 0.1;
  scene.solver.photons = 30000;
  return scene;
}

}  // namespace knotlight::test
