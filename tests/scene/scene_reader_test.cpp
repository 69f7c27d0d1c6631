// Scenes that are right: every key arrives where it belongs. The mistakes are in bad_input_test.
#include "scene/scene_reader.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/image_io.h"
#include "scene/nearest_name.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using test::replaced;
using test::ScratchFolder;

// Positions pass through a rotation by sines and cosines: a few roundings of numbers around 10.
constexpr double rounding = 1e-13;
// Volumes are sums over up to 1e5 facets.
constexpr double rounding_of_sums = 1e-10;

const char* const full_scene = R"(units: mm
camera:
  type: perspective
  from: [0, -6, 2]
  to: [0, 0, 0]
  up: [0, 0, 2]
  fov: 35
  resolution: [320, 240]
  samples: 8
lights:
  - {type: point, position: [3, 0, 3], intensity: 18}
  - {type: directional, direction: [0, 3, -4], irradiance: 1}
  - {type: area, center: [0, 0, 4], u: [1, 0, 0], v: [0, -2, 0], radiance: 5}
  - {type: environment, radiance: 0.5}
materials:
  wax: {type: translucent, sigma_a: 0.02, sigma_s: 20, g: 0.25, ior: 1.4, emission: 0.1, roughness: 0.3}
  floor: {type: diffuse, reflectance: 0.5}
objects:
  - {name: tetra, mesh: tetra.ply, material: wax, scale: 2, rotate: [90, 0, 90], translate: [10, 0, 0]}
  - {name: ball, sphere: {center: [1, 0, 0], radius: 1}, material: wax, scale: 3, rotate: [0, 0, 90]}
  - {name: slab, box: {min: [-1, -1, 0], max: [1, 1, 0.5]}, material: wax}
  - {quad: {center: [0, 0, -1], u: [5, 0, 0], v: [0, 5, 0]}, material: floor}
solver:
  tolerance: 0.02
  source: photon_map
  method: bkm_thesis
  boundary: marshak
  exitance: p1
  photons: 2e5
  knots: 800
  jitter: false
  interior_knots: near_layers
  radial_function: inverse_multiquadric
  radial_exponent: 2.5
  shape_parameter: 1.5
  basis_order: 2
  dense_solver: qr
  svd_cut: 1e-14
  distance_precision: float
  estimate_photons: 100
  divergence: differentiated
  deposits: collisions
  similarity: true
  estimator: kernel
  estimate_radius: 0.5
  irradiance_samples: 5000
)";

// Right-angled tetrahedron with legs 1, outward oriented.
const char* const tetra_ply = R"(ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 4
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
)";

// The smallest scene that is one.
const char* const small_scene = R"(camera: {from: [0, -6, 2], to: [0, 0, 0]}
lights: [{type: environment, radiance: 1}]
materials: {wax: {type: translucent, sigma_a: 0.02, sigma_s: 20}}
objects: [{sphere: {radius: 2}, material: wax}]
)";

Scene read_text_scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const ScratchFolder folder;
  folder.write("tetra.ply", tetra_ply);
  return read_scene(folder.write("scene.yaml", text), overrides);
}

TEST(SceneReader, ReadsCameraAndLights) {
  const Scene scene = read_text_scene(full_scene);
  EXPECT_EQ(scene.units, "mm");
  EXPECT_EQ(scene.channels, 1);
  EXPECT_EQ(scene.camera.type, Camera::Type::perspective);
  EXPECT_EQ(scene.camera.from, Vec3(0, -6, 2));
  EXPECT_EQ(scene.camera.to, Vec3(0, 0, 0));
  EXPECT_EQ(scene.camera.up, Vec3(0, 0, 1));
  EXPECT_EQ(scene.camera.fov, 35);
  EXPECT_EQ(scene.camera.width_px, 320);
  EXPECT_EQ(scene.camera.height_px, 240);
  EXPECT_EQ(scene.camera.samples, 8);

  ASSERT_EQ(scene.lights.size(), 4u);
  const auto& point = std::get<PointLight>(scene.lights[0]);
  EXPECT_EQ(point.position, Vec3(3, 0, 3));
  EXPECT_TRUE((point.intensity == 18).all());
  const auto& directional = std::get<DirectionalLight>(scene.lights[1]);
  EXPECT_NEAR((directional.direction - Vec3(0, 0.6, -0.8)).norm(), 0, rounding);
  EXPECT_TRUE((directional.irradiance == 1).all());
  const auto& area = std::get<AreaLight>(scene.lights[2]);
  EXPECT_EQ(area.center, Vec3(0, 0, 4));
  EXPECT_EQ(area.normal(), Vec3(0, 0, -1));
  EXPECT_EQ(area.area(), 8);
  EXPECT_TRUE((area.radiance == 5).all());
  const auto& sky = std::get<EnvironmentLight>(scene.lights[3]);
  EXPECT_TRUE((sky.radiance == 0.5).all());
  EXPECT_EQ(sky.map, nullptr);
}

TEST(SceneReader, ReadsMaterialsAndSolver) {
  const Scene scene = read_text_scene(full_scene);
  ASSERT_EQ(scene.objects.size(), 4u);
  const TranslucentMaterial* wax = scene.objects[0].translucent();
  ASSERT_NE(wax, nullptr);
  const Medium medium = wax->medium(2);
  EXPECT_EQ(medium.sigma_a, 0.02);
  EXPECT_EQ(medium.sigma_s, 20);
  EXPECT_EQ(medium.g, 0.25);
  EXPECT_EQ(medium.ior, 1.4);
  EXPECT_EQ(medium.emission, 0.1);
  EXPECT_EQ(wax->roughness, 0.3);
  EXPECT_EQ(wax->alpha(), 0.3 * 0.3);
  EXPECT_EQ(scene.objects[3].translucent(), nullptr);
  EXPECT_TRUE((std::get<DiffuseMaterial>(scene.objects[3].material).reflectance == 0.5).all());

  EXPECT_EQ(scene.solver.tolerance, 0.02);
  EXPECT_EQ(scene.solver.source, SourceModel::photon_map);
  EXPECT_EQ(scene.solver.method, Method::bkm_thesis);
  EXPECT_EQ(scene.solver.boundary, Boundary::marshak);
  EXPECT_EQ(scene.solver.exitance, Exitance::p1);
  EXPECT_EQ(scene.solver.photons, 200'000u);
  EXPECT_EQ(scene.solver.knots, 800u);
  const BkmThesisSettings& thesis = scene.solver.thesis;
  EXPECT_EQ(thesis.knot_layout, KnotLayout::stratified);
  EXPECT_EQ(thesis.interior_knots, InteriorLayout::near_layers);
  EXPECT_EQ(thesis.radial_function, RadialKind::inverse_multiquadric);
  EXPECT_EQ(thesis.radial_exponent, 2.5);
  EXPECT_EQ(thesis.shape_parameter, 1.5);
  EXPECT_FALSE(thesis.leave_one_out);
  EXPECT_EQ(thesis.basis_order, 2);
  EXPECT_EQ(thesis.dense_solver, DenseMethod::qr);
  EXPECT_EQ(thesis.svd_cut, 1e-14);
  EXPECT_EQ(thesis.distance_precision, DistancePrecision::single_precision);
  EXPECT_EQ(scene.solver.estimate_photons, 100u);
  EXPECT_EQ(scene.solver.divergence, Divergence::differentiated);
  EXPECT_EQ(scene.solver.deposits, Deposits::collisions);
  EXPECT_TRUE(scene.solver.similarity);
  EXPECT_EQ(scene.solver.estimator, DensityEstimator::kernel);
  EXPECT_EQ(scene.solver.estimate_radius, 0.5);
  EXPECT_EQ(scene.solver.irradiance_samples, 5000u);
}

// Grey vertices leave one channel, coloured ones make it three; on a translucent object they are
// left out with a warning.
TEST(SceneReader, ColouredVertices) {
  const ScratchFolder folder;
  std::string ply = replaced(tetra_ply, "property float z\n",
                             "property float z\nproperty float red\nproperty float green\n"
                             "property float blue\n");
  for (const char* vertex : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"})
    ply = replaced(ply, std::string("\n") + vertex + "\n",
                   std::string("\n") + vertex + " 0.5 0.5 0.5\n");
  folder.write("grey.ply", ply);
  folder.write("red.ply", replaced(ply, "1 0 0 0.5", "1 0 0 0.75"));
  const auto scene_with = [&](const std::string& mesh, const std::string& material) {
    return read_scene(folder.write(
        "scene.yaml", replaced(replaced(small_scene, "materials: {",
                                        "materials: {floor: {type: diffuse, reflectance: 1}, "),
                               "objects: [",
                               "objects: [{mesh: " + mesh + ", material: " + material +
                                   ", translate: [9, 0, 0]}, ")));
  };
  EXPECT_EQ(scene_with("grey.ply", "floor").channels, 1);
  const Scene red = scene_with("red.ply", "floor");
  EXPECT_EQ(red.channels, 3);
  EXPECT_EQ(std::get<TriangleMesh>(red.objects[0].shape).colours.size(), 4U);
  EXPECT_TRUE(red.warnings.empty());
  const Scene wax = scene_with("red.ply", "wax");
  EXPECT_EQ(wax.channels, 1);
  ASSERT_EQ(wax.warnings.size(), 1U);
  EXPECT_NE(wax.warnings[0].find("objects.0.mesh: vertex colours left out"), std::string::npos);
}

TEST(SceneReader, ScalesThenRotatesThenTranslates) {
  const Scene scene = read_text_scene(full_scene);
  EXPECT_EQ(scene.objects[0].name, "tetra");
  // The vertex (0, 1, 0): scaled (0, 2, 0), about x (0, 0, 2), about z the same, moved (10, 0, 2).
  // The vertex (1, 0, 0): (2, 0, 0), (2, 0, 0), (0, 2, 0), (10, 2, 0).
  // The vertex (0, 0, 1): (0, 0, 2), (0, -2, 0), (2, 0, 0), (12, 0, 0).
  const auto& mesh = std::get<TriangleMesh>(scene.objects[0].shape);
  const Bounds box = bounds(mesh);
  EXPECT_NEAR((box.lo - Vec3(10, 0, 0)).norm(), 0, rounding);
  EXPECT_NEAR((box.hi - Vec3(12, 2, 2)).norm(), 0, rounding);
  EXPECT_NEAR(signed_volume(mesh), 8.0 / 6.0, rounding_of_sums);

  EXPECT_EQ(scene.objects[1].name, "ball");
  const auto& ball = std::get<Sphere>(scene.objects[1].shape);
  EXPECT_NEAR((ball.center - Vec3(0, 3, 0)).norm(), 0, rounding);
  EXPECT_NEAR(ball.radius, 3, rounding);
}

// Euler angles in the other order would pass with only two of them.
TEST(SceneReader, RotatesAboutXThenYThenZ) {
  const Scene scene =
      read_text_scene(full_scene, {"objects.ball.rotate=[90, 90, 90]", "objects.ball.scale=1"});
  // (1, 0, 0): about x the same, about y (0, 0, -1), about z the same.
  const auto& ball = std::get<Sphere>(scene.objects[1].shape);
  EXPECT_NEAR((ball.center - Vec3(0, 0, -1)).norm(), 0, rounding);
}

TEST(SceneReader, RefinesTranslucentShapesOnly) {
  const auto longest_edge = [](const Object& object) {
    const auto& mesh = std::get<TriangleMesh>(object.shape);
    double longest = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        longest = std::max(longest, (mesh.corner(t, i) - mesh.corner(t, (i + 1) % 3)).norm());
      }
    }
    return longest;
  };
  const Scene scene = read_text_scene(full_scene);
  EXPECT_LE(longest_edge(scene.objects[0]), 2.0 / 32.0 + rounding);
  EXPECT_LE(longest_edge(scene.objects[2]), 2.0 / 64.0 + rounding);
  EXPECT_NEAR(signed_volume(std::get<TriangleMesh>(scene.objects[2].shape)), 2.0, rounding_of_sums);
  EXPECT_EQ(std::get<TriangleMesh>(scene.objects[3].shape).triangles.size(), 2u);

  const Scene diffuse = read_text_scene(full_scene, {"objects.slab.material=floor"});
  EXPECT_EQ(std::get<TriangleMesh>(diffuse.objects[2].shape).triangles.size(), 12u);
}

TEST(SceneReader, MendedMeshIsReportedWithItsPlace) {
  const ScratchFolder folder;
  // One facet turned round: its winding is mended with a warning.
  folder.write("tetra.ply", replaced(tetra_ply, "3 0 2 1", "3 0 1 2"));
  const Scene scene = read_scene(folder.write("scene.yaml", full_scene));
  ASSERT_FALSE(scene.warnings.empty());
  EXPECT_NE(scene.warnings[0].find("scene.yaml:19: objects.tetra.mesh: "), std::string::npos)
      << scene.warnings[0];
}

// Photons left out: 2e6 (0.01 / tolerance), between 2e5 and 3e7.
TEST(SceneReader, PhotonsFollowTheTolerance) {
  const auto photons = [](const char* tolerance) {
    return read_text_scene(small_scene, {std::string("solver.tolerance=") + tolerance})
        .solver.photons;
  };
  EXPECT_EQ(photons("0.02"), 1'000'000u);
  EXPECT_EQ(photons("0.5"), 200'000u);
  EXPECT_EQ(photons("0.0001"), 30'000'000u);
}

TEST(SceneReader, WhatIsLeftOutHasDefaults) {
  const Scene scene = read_text_scene(small_scene);
  EXPECT_EQ(scene.units, "unit");
  EXPECT_EQ(scene.camera.up, Vec3(0, 0, 1));
  EXPECT_EQ(scene.camera.fov, 40);
  EXPECT_EQ(scene.camera.width_px, 640);
  EXPECT_EQ(scene.camera.height_px, 480);
  EXPECT_EQ(scene.camera.samples, 16);
  EXPECT_EQ(scene.objects[0].name, "object0");
  const Medium medium = scene.objects[0].translucent()->medium(0);
  EXPECT_EQ(medium.g, 0);
  EXPECT_EQ(medium.ior, 1);
  EXPECT_EQ(medium.emission, 0);
  EXPECT_EQ(scene.solver.method, Method::automatic);
  EXPECT_EQ(scene.solver.source, std::nullopt);
  EXPECT_EQ(scene.solver.exitance, std::nullopt);
  EXPECT_EQ(scene.solver.knots, std::nullopt);
  EXPECT_EQ(scene.solver.photons, 2'000'000u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(SceneReader, AnyColourMakesThreeChannels) {
  for (const char* coloured : {"materials.wax.sigma_a=[1, 2, 3]", "materials.wax.sigma_s=[1, 2, 3]",
                               "materials.wax.g=[0.1, 0.2, 0.3]",
                               "materials.wax.emission=[1, 2, 3]", "lights.0.radiance=[1, 2, 3]"}) {
    EXPECT_EQ(read_text_scene(small_scene, {coloured}).channels, 3) << coloured;
  }
  const Scene scene = read_text_scene(small_scene, {"materials.wax.sigma_a=[1, 2, 3]"});
  EXPECT_EQ(scene.objects[0].translucent()->medium(1).sigma_a, 2);
  EXPECT_EQ(scene.objects[0].translucent()->medium(1).sigma_s, 20);
}

TEST(SceneReader, OrthographicCameraHasWidth) {
  const Scene scene =
      read_text_scene(replaced(small_scene, "from:", "type: orthographic, width: 2.5, from:"));
  EXPECT_EQ(scene.camera.type, Camera::Type::orthographic);
  EXPECT_EQ(scene.camera.width, 2.5);
}

TEST(SceneReader, EmissionNeedsNoLights) {
  const std::string dark = replaced(small_scene, "[{type: environment, radiance: 1}]", "[]");
  EXPECT_TRUE(read_text_scene(dark, {"materials.wax.emission=2"}).lights.empty());
}

TEST(SceneReader, AnchorsAndAliasesWork) {
  const Scene scene =
      read_text_scene(replaced(replaced(small_scene, "from: [0, -6, 2]", "from: &eye [0, -6, 2]"),
                               "radius: 2}", "radius: 2, center: *eye}"));
  EXPECT_EQ(std::get<Sphere>(scene.objects[0].shape).center, Vec3(0, -6, 2));
}

TEST(SceneReader, NumbersInAllTheirSpellings) {
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"2", 2}, {"2.0", 2}, {".5", 0.5}, {"5.", 5}, {"+3", 3}, {"1e-3", 1e-3}, {"1E2", 100}}) {
    EXPECT_EQ(read_text_scene(small_scene, {"materials.wax.sigma_a=" + text})
                  .objects[0]
                  .translucent()
                  ->sigma_a[0],
              value)
        << text;
  }
}

TEST(SceneReader, WindowsLineEndsAreFine) {
  std::string text;
  for (const char* c = small_scene; *c != '\0'; ++c) {
    if (*c == '\n') text += '\r';
    text += *c;
  }
  EXPECT_EQ(read_text_scene(text).objects.size(), 1u);
}

TEST(SceneReader, OverridesReplaceAddAndTakeOut) {
  const std::vector<std::string> overrides = {"objects.ball.sphere.radius=7",
                                              "objects.3.name=table",
                                              "objects.table.translate=[0, 0, -4]",
                                              "lights.0.intensity=3",
                                              "solver.knots=null",
                                              "camera.resolution=[10, 20]",
                                              "materials.wax.ior=1.1",
                                              "units=cm"};
  const Scene scene = read_text_scene(full_scene, overrides);
  EXPECT_NEAR(std::get<Sphere>(scene.objects[1].shape).radius, 21, rounding);
  EXPECT_EQ(bounds(scene.objects[3].shape).lo.z(), -5);
  EXPECT_EQ(std::get<PointLight>(scene.lights[0]).intensity[0], 3);
  EXPECT_EQ(scene.solver.knots, std::nullopt);
  EXPECT_EQ(scene.camera.height_px, 20);
  EXPECT_EQ(scene.objects[0].translucent()->ior, 1.1);
  EXPECT_EQ(scene.units, "cm");
  // A map that the file lacks, and the last of two wins.
  EXPECT_EQ(read_text_scene(small_scene, {"solver.photons=10", "solver.photons=20"}).solver.photons,
            20u);
}

TEST(SceneReader, EnvironmentFileIsRelativeToTheScene) {
  const ScratchFolder folder;
  Image image{4, 2, std::vector<Spectrum>(8, Spectrum::Constant(0.5))};
  write_image(folder.path("grey.exr"), image, {});
  image.at(1, 1) = Spectrum(1, 0, 0);
  write_image(folder.path("sky.exr"), image, {});
  const std::string scene_file = folder.write(
      "scene.yaml", replaced(small_scene, "radiance: 1", "radiance: 2, file: sky.exr"));
  const Scene scene = read_scene(scene_file);
  EXPECT_EQ(scene.channels, 3);
  const auto& sky = std::get<EnvironmentLight>(scene.lights[0]);
  ASSERT_NE(sky.map, nullptr);
  EXPECT_EQ(sky.radiance[0], 2);
  EXPECT_NEAR(sky.map->radiance(Vec3(0, 0, 1))[1], 0.5, rounding);
  EXPECT_EQ(read_scene(scene_file, {"lights.0.file=grey.exr"}).channels, 1);
}

TEST(SceneReader, TheScenesOfTheRepositoryAreRight) {
  const std::string scenes = std::string(KNOTLIGHT_ROOT) + "/scenes/";
  const Scene knot = read_scene(scenes + "knot.yaml");
  EXPECT_EQ(knot.channels, 3);
  EXPECT_TRUE(knot.warnings.empty()) << knot.warnings[0];
  // It stands just above the table, which is z = 0.
  const double gap = bounds(knot.objects[0].shape).lo.z();
  EXPECT_GT(gap, 0.0);
  EXPECT_LT(gap, 0.1);
  // The bunny's mesh is fetched, not committed: any mesh does for the check of the rest.
  const Scene bunny = read_scene(scenes + "bunny.yaml", {"objects.bunny.mesh=meshes/knot.ply"});
  EXPECT_EQ(bunny.objects[0].name, "bunny");
  for (const char* name : {"slab", "sphere", "box"}) {
    const Scene scene = read_scene(scenes + "validation/" + name + ".yaml");
    EXPECT_EQ(scene.channels, 1);
    EXPECT_EQ(scene.objects[0].name, name);
    EXPECT_EQ(scene.solver.boundary, Boundary::marshak);
  }
}

TEST(SceneReader, TheExampleOfTheDocumentationIsRight) {
  std::ifstream in(std::string(KNOTLIGHT_ROOT) + "/docs/scene-format.md");
  const std::string page((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string fence = "```yaml\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const Scene scene = read_text_scene(page.substr(begin, page.find("```", begin) - begin));
  EXPECT_EQ(scene.channels, 3);
  EXPECT_EQ(scene.objects.size(), 2u);
}

TEST(NearestName, CountsSlipsOfTheKeyboard) {
  EXPECT_EQ(edit_distance("radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1u);  // swapped
  EXPECT_EQ(edit_distance("radus", "radius"), 1u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(did_you_mean("raduis", {"center", "radius"}), " (did you mean 'radius'?)");
  EXPECT_EQ(did_you_mean("banana", {"center", "radius"}), "");
}

}  // namespace
}  // namespace knotlight
