#include "render/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// A glowing ball of known U_d = 0.5 everywhere above a diffuse floor.
struct BallOnFloor {
  Scene scene;
  std::unique_ptr<RayCaster> caster;
  GlowingSurfaces surfaces;

  explicit BallOnFloor(double ior) {
    TranslucentMaterial wax;
    wax.sigma_a = Spectrum::Constant(0.1);
    wax.sigma_s = Spectrum::Constant(10.0);
    wax.ior = ior;
    scene.objects = {{"ball", Sphere{Vec3::Zero(), 1.0}, wax},
                     {"floor", quad_mesh(Vec3(0, 0, -2), Vec3(9, 0, 0), Vec3(0, 9, 0)),
                      DiffuseMaterial{Spectrum(0.2, 0.4, 0.8)}}};
    scene.camera.width_px = 48;
    scene.camera.height_px = 40;
    scene.camera.samples = 4;
    scene.camera.from = Vec3(0, 0, 6);
    scene.camera.up = Vec3::UnitY();
    scene.camera.type = Camera::Type::orthographic;
    scene.camera.width = 6.0;
    caster = std::make_unique<RayCaster>(
        std::vector<const Shape*>{&scene.objects[0].shape, &scene.objects[1].shape});
    SurfaceGrid grid(scene.objects[0].shape, 8);
    const Eigen::VectorXd U_d = Eigen::VectorXd::Constant(grid.nodes().cols(), 0.5);
    const LeavingRadiance leaving(
        wax.ior, diffusion_coefficients(wax.medium(0), Boundary::marshak).A, Exitance::lambert);
    surfaces.emplace_back(GlowingSurface(grid));
    surfaces.back()->U_d = {U_d};
    surfaces.back()->leaving = {leaving};
    surfaces.emplace_back(std::nullopt);
  }

  // After the shapes have changed.
  void rebuild() {
    caster = std::make_unique<RayCaster>(
        std::vector<const Shape*>{&scene.objects[0].shape, &scene.objects[1].shape});
    surfaces[0]->grid = SurfaceGrid(scene.objects[0].shape, 8);
  }

  Image render(int threads) const {
    Stages stages(false);
    Stage stage(stages, "picture", 1);
    return render_picture(scene.camera, Shading(scene, *caster, surfaces), 7, Workers(threads),
                          stage);
  }
};

// Lambert, matched indices: L = 2 U_d = 1 in every direction; the floor under a directional light
// of irradiance 3 shows reflectance * 3 / pi.
TEST(Picture, GlowAndFloorHaveTheirClosedForms) {
  BallOnFloor world(1.0);
  world.scene.lights = {DirectionalLight{-Vec3::UnitZ(), Spectrum::Constant(3.0)}};
  const Image image = world.render(1);
  EXPECT_NEAR(image.at(24, 20)[0], 1.0, 1e-12);
  EXPECT_NEAR(image.at(2, 2)[2], 0.8 * 3.0 / pi, 1e-12);
  EXPECT_NEAR(image.at(2, 2)[0], 0.2 * 3.0 / pi, 1e-12);
}

// Through an index-matched ball of optical thickness 1.01 along its diameter a sky of radiance 5 is
// seen weakened by exp(-1.01); what the ball itself sends out stays as it was.
TEST(Picture, IndexMatchedObjectsAreSeenThrough) {
  BallOnFloor world(1.0);
  auto& wax = std::get<TranslucentMaterial>(world.scene.objects[0].material);
  wax.sigma_a = Spectrum::Constant(0.005);
  wax.sigma_s = Spectrum::Constant(0.5);
  world.scene.camera.from = Vec3(0, 0, -4);  // below the floor: sky all around
  world.scene.camera.to = Vec3(0, 0, -8);
  world.scene.objects[0].shape = Sphere{Vec3(0, 0, -8), 1.0};
  world.rebuild();
  const double dark = world.render(1).at(24, 20)[0];
  world.scene.lights = {EnvironmentLight{Spectrum::Constant(5.0), nullptr}};
  EXPECT_NEAR(world.render(1).at(24, 20)[0] - dark, 5.0 * std::exp(-1.01), 0.02);
}

// A refracting ball at normal incidence mirrors 4 % of what is behind the eye: a sky of radiance 5.
TEST(Picture, MirrorsItsSurroundings) {
  BallOnFloor world(1.5);
  world.scene.lights = {EnvironmentLight{Spectrum::Constant(5.0), nullptr}};
  const Image lit = world.render(1);
  world.scene.lights.clear();
  const Image dark = world.render(1);
  EXPECT_NEAR(lit.at(24, 20)[0] - dark.at(24, 20)[0], 0.2, 2e-3);
}

TEST(Picture, SameBitsForAnyNumberOfThreads) {
  BallOnFloor world(1.3);
  world.scene.lights = {
      EnvironmentLight{Spectrum::Constant(1.0), nullptr},
      AreaLight{Vec3(0, 0, 5), Vec3(0, 1, 0), Vec3(1, 0, 0), Spectrum::Constant(3.0)}};
  const Image one = world.render(1);
  const Image two = world.render(2);
  for (std::size_t i = 0; i < one.pixels.size(); ++i)
    ASSERT_TRUE((one.pixels[i] == two.pixels[i]).all()) << i;
}

}  // namespace
}  // namespace knotlight
