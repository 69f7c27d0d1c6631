#include "view/solve_thread.h"

#include <gtest/gtest.h>

#include <atomic>

#include "view/view_scenes.h"

namespace knotlight {
namespace {

constexpr PreviewSettings small_preview{10'000, 0.2};

double mean_on_surface(const SolvedView& view) {
  return view.look.surfaces[0]->U_d[0].mean();
}

TEST(PreviewOf, IsNeverBetterThanTheScene) {
  SolverSettings settings;
  settings.photons = 1'000'000;
  settings.tolerance = 0.01;
  EXPECT_EQ(preview_of(settings, {20'000, 0.05}).photons, 20'000U);
  EXPECT_EQ(preview_of(settings, {20'000, 0.05}).tolerance, 0.05);
  settings.photons = 5'000;
  settings.tolerance = 0.2;
  EXPECT_EQ(preview_of(settings, {20'000, 0.05}).photons, 5'000U);
  EXPECT_EQ(preview_of(settings, {20'000, 0.05}).tolerance, 0.2);
}

TEST(SolveThread, EndsWithTheQualityOfTheScene) {
  std::atomic<int> changes{0};
  SolveThread thread({}, [&] { ++changes; });
  EXPECT_EQ(thread.latest(), nullptr);
  thread.request(test::ball(), small_preview, Change::materials);
  thread.wait_until_idle();
  const auto view = thread.latest();
  ASSERT_NE(view, nullptr);
  EXPECT_EQ(view->quality, Quality::full);
  EXPECT_EQ(view->prepared->scene.solver.photons, 30000U);
  EXPECT_EQ(thread.status().activity, SolveThread::Activity::idle);
  EXPECT_TRUE(thread.status().error.empty());
  EXPECT_GE(changes, 4);  // preview begun, shown, full begun, shown
}

// Kept factors give what a solve from nothing gives: twice the light, twice the field.
TEST(SolveThread, FollowsTheLight) {
  SolveThread thread({}, [] {});
  Scene scene = test::ball();
  thread.request(scene, small_preview, Change::materials);
  thread.wait_until_idle();
  const double before = mean_on_surface(*thread.latest());
  std::get<PointLight>(scene.lights[0]).intensity *= 2.0;
  thread.request(scene, small_preview, Change::lights);
  thread.wait_until_idle();
  EXPECT_NEAR(mean_on_surface(*thread.latest()), 2.0 * before, 1e-6 * before);
}

// A change of material must not meet factors of the old one.
TEST(SolveThread, FollowsTheMaterial) {
  Scene scene = test::ball();
  TranslucentMaterial wax = *scene.objects[0].translucent();
  wax.sigma_a = Spectrum::Constant(0.6);
  Scene other = scene;
  other.objects[0].material = wax;

  SolveThread thread({}, [] {});
  thread.request(scene, small_preview, Change::materials);
  thread.wait_until_idle();
  thread.request(other, small_preview, Change::materials);
  thread.wait_until_idle();
  SolveThread fresh({}, [] {});
  fresh.request(other, small_preview, Change::materials);
  fresh.wait_until_idle();
  EXPECT_EQ(thread.latest()->look.surfaces[0]->U_d[0], fresh.latest()->look.surfaces[0]->U_d[0]);
}

TEST(SolveThread, AnotherExitanceKeepsTheSolution) {
  SolveThread thread({}, [] {});
  Scene scene = test::ball();
  scene.solver.exitance = Exitance::p1;
  thread.request(scene, small_preview, Change::materials);
  thread.wait_until_idle();
  const auto before = thread.latest();
  scene.solver.exitance = Exitance::mean_intensity;
  thread.request(scene, small_preview, Change::exitance);
  thread.wait_until_idle();
  const auto after = thread.latest();
  EXPECT_NE(after, before);
  EXPECT_EQ(after->solved, before->solved);
  EXPECT_EQ(after->quality, Quality::full);
  Rng rng(1, Stream::tests, 0);
  const Ray ray{Vec3(0, -5, 0), Vec3::UnitY()};
  const auto hit = after->prepared->caster->nearest(ray);
  ASSERT_TRUE(hit.has_value());
  // The thesis's L = U_d.
  EXPECT_NEAR(after->look.shading->radiance(ray, rng)[0],
              after->look.surfaces[0]->grid.interpolate(after->look.surfaces[0]->U_d[0], *hit),
              1e-9);
}

TEST(SolveThread, ErrorsKeepTheLastGoodView) {
  SolveThread thread({}, [] {});
  Scene scene = test::ball();
  thread.request(scene, small_preview, Change::materials);
  thread.wait_until_idle();
  const auto good = thread.latest();
  Scene bad = scene;
  bad.solver.source = SourceModel::irradiance_thesis;
  bad.solver.method = Method::grid;
  thread.request(bad, small_preview, Change::materials);
  thread.wait_until_idle();
  EXPECT_NE(thread.status().error.find("irradiance_thesis"), std::string::npos);
  EXPECT_EQ(thread.latest(), good);
  // Back again, with an exitance alone: what could not be solved is not forgotten.
  scene.solver.exitance = Exitance::lambert;
  thread.request(scene, small_preview, Change::exitance);
  thread.wait_until_idle();
  EXPECT_TRUE(thread.status().error.empty());
  EXPECT_NE(thread.latest()->solved, good->solved);
  scene.lights.clear();
  thread.request(scene, small_preview, Change::lights);
  thread.wait_until_idle();
  EXPECT_NE(thread.status().error.find("nothing shines"), std::string::npos);
}

// A hand on a slider: many wishes, of which the last one counts, with the strongest change of all.
TEST(SolveThread, ManyWishesEndInTheLast) {
  SolveThread thread({}, [] {});
  Scene scene = test::ball();
  for (int i = 1; i <= 10; ++i) {
    TranslucentMaterial wax = *scene.objects[0].translucent();
    wax.sigma_a = Spectrum::Constant(0.1 * i);
    scene.objects[0].material = wax;
    thread.request(scene, small_preview, i == 10 ? Change::lights : Change::materials);
  }
  thread.wait_until_idle();
  EXPECT_EQ(thread.latest()->prepared->scene.objects[0].translucent()->sigma_a[0], 1.0);
  EXPECT_EQ(thread.latest()->quality, Quality::full);
}

// Leaving does not wait for the full solve.
TEST(SolveThread, EndsInTheMiddleOfASolve) {
  Scene scene = test::ball();
  scene.solver.photons = 50'000'000;  // minutes
  const auto start = std::chrono::steady_clock::now();
  {
    SolveThread thread({}, [] {});
    thread.request(scene, small_preview, Change::materials);
    while (thread.status().activity != SolveThread::Activity::full)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    // A newer wish stops it too.
    scene.solver.photons = 30'000;
    thread.request(scene, small_preview, Change::lights);
    thread.wait_until_idle();
    EXPECT_EQ(thread.latest()->prepared->scene.solver.photons, 30'000U);
    scene.solver.photons = 50'000'000;
    thread.request(scene, small_preview, Change::lights);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

}  // namespace
}  // namespace knotlight
