#include "rivals/dipole_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "rival_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;

Image picture(PreparedScene& p, const DipoleSettings& settings, int threads = 2) {
  RunOptions options;
  options.quiet = true;
  options.threads = threads;
  RunContext run(options, false);
  return dipole_picture(p, settings, run);
}

double mean(const Image& image) {
  double sum = 0.0;
  for (const Spectrum& pixel : image.pixels) sum += pixel[0];
  return sum / static_cast<double>(image.pixels.size());
}

// A half-space under a beam, seen obliquely through a small window: L = T M / (pi m), m the
// diffuse transmittance of the surface seen from outside, and the closed form of light scattered
// once. The noise is 0.5 % at a place and less over the window; 0.15 % is cut off at the box's
// edges.
TEST(DipolePicture, HalfSpaceUnderABeam) {
  for (const double ior : {1.0, 1.4}) {
    const Medium m{0.1, 0.9, 0.0, ior, 0.0};
    PreparedScene p = test::half_space(m, test::beam(-Vec3::UnitZ(), 3.0));
    Camera& camera = p.scene.camera;
    camera.type = Camera::Type::orthographic;
    camera.from = Vec3(6.0, 0.0, 8.0);
    camera.to = Vec3::Zero();
    camera.width = 4.0;
    camera.width_px = camera.height_px = 12;
    camera.samples = 4;
    DipoleSettings settings;
    settings.single_scattering = false;
    const double T_in = 1.0 - fresnel_reflectance(1.0, ior);
    const double T_out = 1.0 - fresnel_reflectance(0.8, ior);
    const double M = 3.0 * T_in * dipole_kernel(m, DipoleForm::classic).total();
    const double diffuse = ior * ior * transmitted_flux_moment(ior, 0.0);
    const double multiple = T_out * M / (pi * diffuse);
    EXPECT_NEAR(mean(picture(p, settings)) / multiple, 1.0, 0.01) << ior;
    settings.single_scattering = true;
    const double mu_in = std::sqrt(1.0 - 0.36 / (ior * ior));
    const double once = T_out / (ior * ior) * T_in * 3.0 * 0.9 / (4.0 * pi) / (1.0 + mu_in);
    EXPECT_NEAR(mean(picture(p, settings)) / (multiple + once), 1.0, 0.01) << ior;
  }
}

TEST(DipolePicture, SameBitsForAnyNumberOfThreads) {
  PreparedScene p = test::one_object(refine(box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1)), 0.5),
                                     {0.1, 4.0, 0.0, 1.3, 0.0},
                                     EnvironmentLight{Spectrum::Constant(1.0), nullptr});
  p.scene.camera.width_px = p.scene.camera.height_px = 24;
  p.scene.camera.samples = 2;
  DipoleSettings settings;
  settings.single_scattering = true;
  const Image one = picture(p, settings, 1);
  const Image three = picture(p, settings, 3);
  for (std::size_t i = 0; i < one.pixels.size(); ++i)
    ASSERT_TRUE((one.pixels[i] == three.pixels[i]).all()) << i;
  EXPECT_GT(mean(one), 0.0);
}

}  // namespace
}  // namespace knotlight
