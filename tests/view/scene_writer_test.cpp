#include "view/scene_writer.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/file_io.h"
#include "scene/scene_reader.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using test::ScratchFolder;

constexpr const char* text = R"(# A ball in
# the sun
units: "my unit"
camera: {from: [0, -5, 1], to: [0, 0, 0], fov: 35, samples: 4}
lights:
  - {type: point, position: [3, 0, 3], intensity: 18}
  - {type: directional, direction: [0, 0, -2], irradiance: 1}
  - type: area
    center: [0, 0, 4]
    u: [1, 0, 0]
    v: [0, 1, 0]
    radiance: [5, 4, 3]
  - {type: environment, radiance: 0.1}
materials:
  "wax: pale": {type: translucent, sigma_a: 0.1, sigma_s: [6, 7, 8], ior: 1.3}
  floor: {type: diffuse, reflectance: 0.5}
objects:
  - {name: "the ball", sphere: {radius: 1}, material: "wax: pale"}
  - {name: twin, sphere: {center: [4, 0, 0], radius: 0.5}, material: "wax: pale"}
  - {quad: {center: [0, 0, -1], u: [5, 0, 0], v: [0, 5, 0]}, material: floor}
solver: {knots: 100, photons: 1e5}
)";

Scene changed(const YamlNode& read, const Scene& before, const Scene& after,
              const ScratchFolder& folder) {
  YamlNode document = read;
  put_changes(document, before, after);
  return read_scene(folder.write("changed.yaml", yaml_text(document)));
}

TEST(SceneWriter, WritesWhatWasRead) {
  const ScratchFolder folder;
  const std::string file = folder.write("scene.yaml", text);
  const Scene scene = read_scene(file);
  const std::string once = yaml_text(read_yaml(file));
  const std::string again = folder.write("again.yaml", once);
  EXPECT_EQ(yaml_text(read_yaml(again)), once);
  const Scene copy = read_scene(again);
  EXPECT_EQ(copy.units, "my unit");
  EXPECT_EQ(copy.channels, scene.channels);
  EXPECT_EQ(copy.camera.from, scene.camera.from);
  EXPECT_EQ(copy.lights.size(), scene.lights.size());
  EXPECT_EQ(copy.objects[0].name, "the ball");
  EXPECT_EQ(copy.objects[1].translucent()->ior, 1.3);
  EXPECT_EQ(copy.solver.knots, 100U);
  EXPECT_EQ(leading_comment(file), "# A ball in\n# the sun\n");
}

TEST(SceneWriter, EveryChangeComesBack) {
  const ScratchFolder folder;
  const std::string file = folder.write("scene.yaml", text);
  const Scene before = read_scene(file);
  Scene after = before;
  after.camera.from = Vec3(1.0 / 3.0, -4, 2);
  after.camera.to = Vec3(0.1, 0, 0);
  std::get<PointLight>(after.lights[0]) = {Vec3(1, 2, 3), Spectrum::Constant(7.5)};
  std::get<DirectionalLight>(after.lights[1]).direction = Vec3(0.6, 0, -0.8);
  std::get<AreaLight>(after.lights[2]).center = Vec3(0, 1, 4);
  std::get<AreaLight>(after.lights[2]).radiance = Spectrum::Constant(2.0);
  std::get<EnvironmentLight>(after.lights[3]).radiance = Spectrum(0.1, 0.2, 0.3);
  TranslucentMaterial wax = *before.objects[0].translucent();
  wax.sigma_a = Spectrum(0.1, 0.2, 0.7);
  wax.sigma_s = Spectrum(9, 9, 9);
  wax.g = Spectrum::Constant(0.5);
  wax.ior = 1.45;
  after.objects[0].material = wax;
  after.objects[1].material = wax;
  std::get<DiffuseMaterial>(after.objects[2].material).reflectance = Spectrum::Constant(0.25);
  after.solver.tolerance = 0.02;
  after.solver.source = SourceModel::boundary_flux;
  after.solver.method = Method::lbkm;
  after.solver.boundary = Boundary::marshak;
  after.solver.exitance = Exitance::lambert;
  after.solver.photons = 123456;

  const Scene copy = changed(read_yaml(file), before, after, folder);
  EXPECT_EQ(copy.camera.from, after.camera.from);
  EXPECT_EQ(copy.camera.to, after.camera.to);
  EXPECT_EQ(std::get<PointLight>(copy.lights[0]).position, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<PointLight>(copy.lights[0]).intensity[2], 7.5);
  EXPECT_LT((std::get<DirectionalLight>(copy.lights[1]).direction - Vec3(0.6, 0, -0.8)).norm(),
            1e-15);
  EXPECT_EQ(std::get<AreaLight>(copy.lights[2]).center, Vec3(0, 1, 4));
  EXPECT_EQ(std::get<AreaLight>(copy.lights[2]).radiance[0], 2.0);
  EXPECT_TRUE(
      (std::get<EnvironmentLight>(copy.lights[3]).radiance == Spectrum(0.1, 0.2, 0.3)).all());
  for (const int i : {0, 1}) {
    const TranslucentMaterial& read = *copy.objects[static_cast<std::size_t>(i)].translucent();
    EXPECT_TRUE((read.sigma_a == wax.sigma_a).all());
    EXPECT_TRUE((read.sigma_s == wax.sigma_s).all());
    EXPECT_TRUE((read.g == wax.g).all());
    EXPECT_EQ(read.ior, 1.45);
  }
  EXPECT_EQ(std::get<DiffuseMaterial>(copy.objects[2].material).reflectance[0], 0.25);
  EXPECT_EQ(copy.solver.tolerance, 0.02);
  EXPECT_EQ(copy.solver.source, SourceModel::boundary_flux);
  EXPECT_EQ(copy.solver.method, Method::lbkm);
  EXPECT_EQ(copy.solver.boundary, Boundary::marshak);
  EXPECT_EQ(copy.solver.exitance, Exitance::lambert);
  EXPECT_EQ(copy.solver.photons, 123456U);
  EXPECT_EQ(copy.solver.knots, 100U);
}

// A grey change of a grey scene leaves it with one channel.
TEST(SceneWriter, GreyScenesStayGrey) {
  const ScratchFolder folder;
  const std::string file = folder.write(
      "grey.yaml",
      "camera: {from: [0, -5, 1], to: [0, 0, 0]}\nlights: [{type: environment, radiance: 1}]\n"
      "materials: {wax: {type: translucent, sigma_a: 0.1, sigma_s: 9}}\n"
      "objects: [{sphere: {radius: 1}, material: wax}]\n");
  const Scene before = read_scene(file);
  Scene after = before;
  std::get<EnvironmentLight>(after.lights[0]).radiance = Spectrum::Constant(2.0);
  after.solver.tolerance = 0.1;
  const Scene copy = changed(read_yaml(file), before, after, folder);
  EXPECT_EQ(copy.channels, 1);
  EXPECT_EQ(std::get<EnvironmentLight>(copy.lights[0]).radiance[1], 2.0);
  // Left out, the number of photons would have followed the tolerance.
  EXPECT_EQ(copy.solver.photons, before.solver.photons);
}

TEST(SceneWriter, MovesPathsOfFiles) {
  YamlNode document = parse_yaml_value(
      "{lights: [{file: sky.hdr}, {file: /abs/sky.hdr}], objects: [{mesh: ../m/a.ply}, {sphere: "
      "{}}]}",
      "test");
  move_paths(document, "/data/scenes", "/data/out/x");
  EXPECT_EQ(document.find("lights")->items[0].find("file")->text, "../../scenes/sky.hdr");
  EXPECT_EQ(document.find("lights")->items[1].find("file")->text, "/abs/sky.hdr");
  EXPECT_EQ(document.find("objects")->items[0].find("mesh")->text, "../../m/a.ply");
}

}  // namespace
}  // namespace knotlight
