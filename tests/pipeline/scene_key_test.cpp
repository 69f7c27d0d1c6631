#include "pipeline/scene_key.h"

#include <gtest/gtest.h>

#include <functional>

namespace knotlight {
namespace {

Scene a_scene() {
  Scene scene;
  scene.units = "mm";
  scene.lights = {
      PointLight{{1, 2, 3}, Spectrum::Ones()}, DirectionalLight{-Vec3::UnitZ(), Spectrum::Ones()},
      AreaLight{},
      EnvironmentLight{Spectrum::Ones(), std::make_shared<const EnvironmentMap>(
                                             2, 1, std::vector<Spectrum>(2, Spectrum::Ones()))}};
  scene.objects = {{"ball", Sphere{}, TranslucentMaterial{}},
                   {"box", box_mesh(Vec3::Zero(), Vec3::Ones()), DiffuseMaterial{}}};
  return scene;
}

// Each change is found, and named.
TEST(SceneKey, KnowsEveryPartOfAScene) {
  const auto difference = [](const std::function<void(Scene&)>& change) {
    Scene changed = a_scene();
    change(changed);
    return first_difference(solution_key(a_scene(), 1), solution_key(changed, 1));
  };
  EXPECT_EQ(difference([](Scene&) {}), "");
  EXPECT_EQ(difference([](Scene& s) { s.camera.from.x() += 1.0; }), "");
  EXPECT_EQ(difference([](Scene& s) { s.solver.exitance = Exitance::lambert; }), "");
  EXPECT_EQ(difference([](Scene& s) { s.channels = 3; }), "the number of channels");
  EXPECT_EQ(difference([](Scene& s) { std::get<PointLight>(s.lights[0]).intensity[2] = 2.0; }),
            "lights.0");
  EXPECT_EQ(difference([](Scene& s) { std::get<DirectionalLight>(s.lights[1]).direction.x() = 1; }),
            "lights.1");
  EXPECT_EQ(difference([](Scene& s) { std::get<AreaLight>(s.lights[2]).v.x() = 1.0; }), "lights.2");
  EXPECT_EQ(difference([](Scene& s) {
              std::get<EnvironmentLight>(s.lights[3]).map = std::make_shared<const EnvironmentMap>(
                  2, 1, std::vector<Spectrum>{Spectrum::Ones(), Spectrum::Constant(1.0 + 1e-12)});
            }),
            "lights.3");
  EXPECT_EQ(difference([](Scene& s) { s.lights.pop_back(); }), "the number of lights");
  EXPECT_EQ(difference([](Scene& s) { std::swap(s.lights[0], s.lights[1]); }), "lights.0");
  EXPECT_EQ(difference([](Scene& s) { std::get<Sphere>(s.objects[0].shape).radius = 2.0; }),
            "the shape of object 'ball'");
  EXPECT_EQ(difference([](Scene& s) {
              std::get<TranslucentMaterial>(s.objects[0].material).roughness = 0.1;
            }),
            "the material of object 'ball'");
  EXPECT_EQ(difference([](Scene& s) {
              std::swap(std::get<TriangleMesh>(s.objects[1].shape).triangles[0][0],
                        std::get<TriangleMesh>(s.objects[1].shape).triangles[0][1]);
            }),
            "the shape of object 'box'");
  EXPECT_EQ(difference([](Scene& s) { s.objects.pop_back(); }), "the number of objects");
  EXPECT_EQ(difference([](Scene& s) { s.solver.thesis.svd_cut = 1e-3; }),
            "solver's keys of bkm_thesis");
  EXPECT_EQ(first_difference(solution_key(a_scene(), 1), solution_key(a_scene(), 2)), "the seed");
}

TEST(SceneKey, ListsOfOtherLengthsDiffer) {
  const std::vector<KeyPart> one = {{"a", 1}}, two = {{"a", 1}, {"b", 2}};
  EXPECT_EQ(first_difference(one, two), "b");
  EXPECT_EQ(first_difference(two, one), "b");
}

}  // namespace
}  // namespace knotlight
