// Every mistake a scene can contain gives one line that says where it is and what was expected.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "scene/scene_reader.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using test::replaced;
using test::ScratchFolder;

// Line numbers count from 1 at `units`.
const char* const good_scene = R"(units: mm
camera:
  from: [0, -6, 2]
  to: [0, 0, 0]
  up: [0, 0, 1]
  fov: 35
  resolution: [64, 48]
  samples: 4
lights:
  - {type: point, position: [3, 0, 3], intensity: 18}
  - {type: directional, direction: [0, 0, -1], irradiance: 1}
  - {type: area, center: [0, 0, 4], u: [1, 0, 0], v: [0, 1, 0], radiance: 5}
  - {type: environment, radiance: 1}
materials:
  wax: {type: translucent, sigma_a: 0.02, sigma_s: 20, g: 0.0, ior: 1.3, emission: 0}
  floor: {type: diffuse, reflectance: 0.5}
objects:
  - {name: ball, sphere: {center: [0, 0, 0], radius: 1}, material: wax, scale: 1}
  - {name: slab, box: {min: [-1, -1, 0], max: [1, 1, 0.5]}, material: wax}
  - {name: table, quad: {center: [0, 0, -1], u: [5, 0, 0], v: [0, 5, 0]}, material: floor}
solver:
  tolerance: 0.01
  photons: 1000
)";

// what() of the InputError that reading the file gives; empty if it gives none.
std::string error_of(const std::string& file, const std::vector<std::string>& overrides = {}) {
  try {
    read_scene(file, overrides);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

struct Mistake {
  const char* from;   // first place in good_scene ...
  const char* to;     // ... that becomes this
  const char* start;  // the message after "file:"
  const char* part;   // and what else it says
};

const Mistake mistakes[] = {
    // The tree
    {"units: mm", "unist: mm", "1: unist: unknown key 'unist' (did you mean 'units'?)",
     "expected units, camera, lights"},
    {"fov: 35", "fvo: 35", "6: camera.fvo: unknown key 'fvo' (did you mean 'fov'?)", "samples"},
    {"fov: 35", "zoom: 35", "6: camera.zoom: unknown key 'zoom', expected type", ""},
    {"ior: 1.3", "eta: 1.3", "15: materials.wax.eta: unknown key", "ior"},
    {"radius: 1}", "raduis: 1}", "18: objects.ball.sphere.raduis: unknown key", "'radius'?"},
    {"intensity: 18", "power: 18", "10: lights.0.power: unknown key", "intensity"},
    {"photons: 1000", "photon: 1000", "23: solver.photon: unknown key", "'photons'?"},
    {"samples: 4", "fov: 20", "8: 'fov': the key is given twice", ":6), expected once"},
    {"units: mm\n", "camera: 1\n", "2: 'camera': the key is given twice", ":1), expected once"},
    {"  floor:", "  wax:", "16: 'wax': the key is given twice", ""},
    {"  fov: 35", "\tfov: 35", "6: the line is indented by a tab, expected spaces", ""},
    {"[64, 48]", "[64, 48", "8: not valid YAML", ""},
    {"intensity: 18}", "intensity: 18", "12: not valid YAML", ""},
    {"units: mm", "units: *mm", "1: not valid YAML", ""},
    {"units: mm", "units: m\x01m", "1: contains the byte 0x01, expected a text file", ""},
    {"units: mm\n", "--- 1\n---\n", "3: a second YAML document begins", "expected one"},
    {"units: mm\n", "? [1, 2]\n: mm\n", "1: a key is not a word", "expected"},
    {"units: mm",
     "units: [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
     "1: is nested too deeply", ""},
    {"units: mm", "units: &a [*a]", "1: ", ""},
    {"units: mm", "units: 5", "1: units: is '5', expected the name of a unit", ""},
    {"units: mm", "units: [mm]", "1: units: is a list of 1, expected the name of a unit", ""},
    {"units: mm", "units: ''", "1: units: is the text ''", "expected"},
    // Numbers
    {"fov: 35", "fov: wide", "6: camera.fov: is 'wide', expected a number > 0 and < 180", ""},
    {"fov: 35", "fov: '35'", "6: camera.fov: is the text '35', expected a number", ""},
    {"fov: 35", "fov: [35]", "6: camera.fov: is a list of 1, expected a number", ""},
    {"fov: 35", "fov:", "6: camera.fov: is empty, expected a number", ""},
    {"fov: 35", "fov: 180", "6: camera.fov: is '180', expected a number > 0 and < 180", ""},
    {"fov: 35", "fov: 0", "6: camera.fov: is '0', expected", ""},
    {"sigma_a: 0.02", "sigma_a: 1.0mm", "15: materials.wax.sigma_a: is '1.0mm', expected", ""},
    {"sigma_a: 0.02", "sigma_a: 0,02", "15: materials.wax.", ""},
    {"sigma_a: 0.02", "sigma_a: 0x10", "15: materials.wax.sigma_a: is '0x10', expected", ""},
    {"sigma_a: 0.02", "sigma_a: nan", "15: materials.wax.sigma_a: is 'nan', which is not finite",
     "expected a number >= 0"},
    {"sigma_a: 0.02", "sigma_a: .NaN", "15: materials.wax.sigma_a: is '.NaN', which is not finite",
     ""},
    {"sigma_a: 0.02", "sigma_a: -.inf", "15: materials.wax.sigma_a: is '-.inf', which is not", ""},
    {"sigma_a: 0.02", "sigma_a: infinity", "15: materials.wax.sigma_a: is 'infinity', which", ""},
    {"sigma_a: 0.02", "sigma_a: 1e999", "15: materials.wax.sigma_a: is '1e999', beyond", ""},
    {"sigma_a: 0.02", "sigma_a: true", "15: materials.wax.sigma_a: is 'true', expected", ""},
    {"[0, -6, 2]", "[0, -6]", "3: camera.from: is a list of 2, expected a list of 3 numbers", ""},
    {"[0, -6, 2]", "[0, -6, x]", "3: camera.from.2: is 'x', expected a number", ""},
    {"[0, -6, 2]", "[0, -6, .nan]", "3: camera.from.2: is '.nan', which is not finite", ""},
    {"[0, -6, 2]", "[0, -6, 1e300]", "3: camera.from.2: is '1e300', expected a number >=", ""},
    {"[0, -6, 2]", "7", "3: camera.from: is '7', expected a list of 3 numbers", ""},
    // Camera
    {"camera:", "camera: 5\nother:", "3: other: unknown key", ""},
    {"  from: [0, -6, 2]\n", "", "2: camera.from: is missing, expected a point", ""},
    {"  to: [0, 0, 0]\n", "", "2: camera.to: is missing, expected a point", ""},
    {"to: [0, 0, 0]", "to: [0, -6, 2]", "4: camera.to: is the same point as camera.from", ""},
    {"up: [0, 0, 1]", "up: [0, 0, 0]", "5: camera.up: has no length, expected a direction", ""},
    {"up: [0, 0, 1]", "up: [0, -12, 4]", "5: camera.up: is parallel to the line of sight", ""},
    {"[0, -6, 2]\n  to: [0, 0, 0]\n  up: [0, 0, 1]", "[0, 0, 2]\n  to: [0, 0, 0]",
     "4: camera.to: is straight above or below", "expected an `up`"},
    {"fov: 35", "width: 35", "6: camera.width: belongs to an orthographic camera", "expected fov"},
    {"up: [0, 0, 1]", "type: orthographic", "6: camera.fov: belongs to a perspective camera",
     "expected width"},
    {"fov: 35", "type: orthographic", "2: camera.width: is missing", "expected"},
    {"fov: 35", "type: fisheye", "6: camera.type: is 'fisheye', expected perspective or", ""},
    {"[64, 48]", "[64, 0]", "7: camera.resolution.1: is '0', expected a whole number from 1", ""},
    {"[64, 48]", "[64, 4.5]", "7: camera.resolution.1: is '4.5', expected a whole number", ""},
    {"[64, 48]", "[64, 70000]", "7: camera.resolution.1: is '70000'", "to 65536"},
    {"[64, 48]", "[64]", "7: camera.resolution: does not have 2 entries", "expected"},
    {"[64, 48]", "64", "7: camera.resolution: is '64', expected [width, height]", ""},
    {"samples: 4", "samples: 0", "8: camera.samples: is '0', expected a whole number from 1", ""},
    // Lights
    {"type: point, ", "", "10: lights.0.type: is missing, expected point, directional", ""},
    {"type: point", "type: pont", "10: lights.0.type: is 'pont' (did you mean 'point'?)", ""},
    {"intensity: 18", "intensity: -1", "10: lights.0.intensity: is '-1', expected a number >= 0",
     ""},
    {"intensity: 18", "intensity: [1, 2]", "10: lights.0.intensity: is a list of 2", "[r, g, b]"},
    {"intensity: 18", "intensity: [1, 2, -3]", "10: lights.0.intensity.2: is '-3'", ""},
    {", intensity: 18", "", "10: lights.0.intensity: is missing, expected W/sr", ""},
    {"[0, 0, -1]", "[0, 0, 0]", "11: lights.1.direction: has no length", "expected a direction"},
    {"v: [0, 1, 0]", "v: [2, 0, 0]", "12: lights.2: u and v span no area", "expected"},
    {"environment, radiance: 1", "environment", "13: lights.3.radiance: is missing", "file"},
    {"environment, radiance: 1", "environment, file: none.hdr", "13: lights.3.file: ", "none.hdr"},
    {"  - {type: point", "  - point\n  - {type: point", "10: lights.0: is not a map", "expected"},
    // Materials
    {"type: translucent, ", "", "15: materials.wax.type: is missing, expected translucent", ""},
    {"translucent", "transluscent", "15: materials.wax.type: is 'transluscent' (did you mean", ""},
    {"sigma_s: 20", "sigma_s: -20", "15: materials.wax.sigma_s: is '-20', expected a number >= 0",
     ""},
    {", sigma_s: 20", "", "15: materials.wax.sigma_s: is missing, expected the scattering", ""},
    {"sigma_a: 0.02, sigma_s: 20", "sigma_a: [1, 0, 1], sigma_s: 0",
     "15: materials.wax: sigma_a + sigma_s is 0 in channel 1, expected > 0", ""},
    {"g: 0.0", "g: 1", "15: materials.wax.g: is '1', expected a number > -1 and < 1", ""},
    {"g: 0.0", "g: [0, 0, -1]", "15: materials.wax.g.2: is '-1', expected", ""},
    {"ior: 1.3", "ior: 0.9", "15: materials.wax.ior: is '0.9', expected a number >= 1", ""},
    {"ior: 1.3", "ior: [1.3, 1.3, 1.4]", "15: materials.wax.ior: is a list of 3", "a number"},
    {"emission: 0", "roughness: 1.5", "15: materials.wax.roughness: is '1.5', expected a number",
     "<= 1"},
    {"emission: 0", "roughness: [0, 1]", "15: materials.wax.roughness: is a list of 2", "a number"},
    {"emission: 0", "rougness: 0", "15: materials.wax.rougness: unknown key", "'roughness'?"},
    {"emission: 0", "emission: -1", "15: materials.wax.emission: is '-1', expected", ""},
    {"reflectance: 0.5", "reflectance: 1.5", "16: materials.floor.reflectance: is '1.5', expected",
     "<= 1"},
    // Objects
    {"material: floor", "material: flor", "20: objects.table.material: there is no material 'flor'",
     "(did you mean 'floor'?), expected floor or wax"},
    {", material: wax, scale", ", scale", "18: objects.ball.material: is missing", "expected"},
    {"radius: 1", "radius: 0", "18: objects.ball.sphere.radius: is '0', expected a number", ""},
    {"{center: [0, 0, 0], radius: 1}", "1", "18: objects.ball.sphere: is '1', expected a map", ""},
    {"radius: 1}", "radius: 1}, box: {}", "18: objects.ball.box: is a second shape besides sphere",
     "expected one of"},
    {"sphere: {center: [0, 0, 0], radius: 1}, ", "", "18: objects.ball: has no shape", "expected"},
    {"max: [1, 1, 0.5]", "max: [1, 1, 0]", "19: objects.slab.box.max: is not beyond min",
     "expected min < max"},
    {"v: [0, 5, 0]", "v: [5, 0, 0]", "20: objects.table.quad: u and v span no area", ""},
    {"material: floor", "material: wax", "20: objects.table.quad: is not closed", "expected"},
    {"name: slab", "name: ball", "19: objects.ball: there is another object 'ball'", "expected"},
    {"scale: 1", "scale: 0", "18: objects.ball.scale: is '0', expected a number", ""},
    {"scale: 1", "scale: -2", "18: objects.ball.scale: is '-2', expected a number", ""},
    {"scale: 1", "scale: [1, 2, 1]", "18: objects.ball.scale: is a list, expected one number", ""},
    {"scale: 1", "rotate: 90", "18: objects.ball.rotate: is '90', expected a list of 3", ""},
    {"radius: 1}, material: wax, scale: 1", "radius: 1e9}, material: wax, scale: 1e9",
     "18: objects.ball.sphere: is too large", "expected"},
    {"sphere: {center: [0, 0, 0], radius: 1}", "mesh: none.ply",
     "18: objects.ball.mesh: ", "none.ply"},
    {"sphere: {center: [0, 0, 0], radius: 1}", "mesh: 3", "18: objects.ball.mesh: is '3', expected",
     ""},
    // Solver
    {"tolerance: 0.01", "tolerance: 0", "22: solver.tolerance: is '0', expected a number > 0", ""},
    {"tolerance: 0.01", "tolerance: 1", "22: solver.tolerance: is '1', expected", "< 1"},
    {"photons: 1000", "photons: 0", "23: solver.photons: is '0', expected a whole number from 1",
     ""},
    {"photons: 1000", "photons: 10.5", "23: solver.photons: is '10.5', expected a whole", ""},
    {"photons: 1000", "photons: 1e30", "23: solver.photons: is '1e30', expected a whole", ""},
    {"photons: 1000", "photons: nan", "23: solver.photons: is 'nan', expected a whole", ""},
    {"photons: 1000", "knots: 3", "23: solver.knots: is '3', expected a whole number from 4", ""},
    {"photons: 1000", "jitter: 1", "23: solver.jitter: is '1', expected true or false", ""},
    {"photons: 1000", "svd_cut: 1", "23: solver.svd_cut: is '1', expected", "< 1"},
    {"photons: 1000", "knot_layout: blue_nois",
     "23: solver.knot_layout: is 'blue_nois' (did you mean 'blue_noise'?), expected vertices", ""},
    {"photons: 1000", "interior_knots: two_layer",
     "23: solver.interior_knots: is 'two_layer' (did you mean 'two_layers'?), expected none", ""},
    {"photons: 1000", "radial_function: gauss", "23: solver.radial_function: is 'gauss'", "cubic"},
    {"photons: 1000", "radial_exponent: 2",
     "23: solver.radial_exponent: belongs to the multiquadrics, expected", ""},
    {"photons: 1000", "radial_order: 2",
     "23: solver.radial_order: belongs to the non-singular solutions, expected", ""},
    {"photons: 1000", "basis_order: 5", "23: solver.basis_order: is '5', expected a whole", "4"},
    {"photons: 1000", "dense_solver: svdd", "23: solver.dense_solver: is 'svdd' (did you mean",
     "'svd'?"},
    {"photons: 1000", "dense_solver: tikhonov_gvc", "23: solver.dense_solver: is 'tikhonov_gvc'",
     "'tikhonov_gcv'?"},
    {"photons: 1000", "distance_precision: half", "23: solver.distance_precision: is 'half', ex",
     "double or float"},
    {"photons: 1000", "shape_parameter: leave_one_ou",
     "23: solver.shape_parameter: is 'leave_one_ou' (did you mean 'leave_one_out'?), expected", ""},
    {"photons: 1000", "jitter: true\n  knot_layout: vertices",
     "23: solver.jitter: says again what knot_layout says, expected", ""},
    {"photons: 1000", "dense_solver: lu\n  svd_cut: 1e-9",
     "24: solver.svd_cut: is not used by this dense_solver, expected svd or qr", ""},
    {"photons: 1000", "radial_function: cubic\n  shape_parameter: 2",
     "24: solver.shape_parameter: is not used by this radial_function, expected none", ""},
    {"photons: 1000", "source: irradiance_thesis\n  interior_knots: grid",
     "24: solver.interior_knots: has no knots one mean free path down", "two_layers"},
    {"photons: 1000", "shape_parameter: [1]", "23: solver.shape_parameter: is a list", "expected"},
    {"photons: 1000", "shape_parameter: 0", "23: solver.shape_parameter: is '0', expected", ""},
    {"photons: 1000", "method: bmk_thesis",
     "23: solver.method: is 'bmk_thesis' (did you mean 'bkm_thesis'?), expected auto, b", ""},
    {"photons: 1000", "exitance: gathr",
     "23: solver.exitance: is 'gathr' (did you mean 'gather'?), expected gather", ""},
    {"photons: 1000", "method: [bkm_thesis]", "23: solver.method: is a list of 1, expected", ""},
    {"photons: 1000", "source: boundary_flx",
     "23: solver.source: is 'boundary_flx' (did you mean 'boundary_flux'?), expected photon_map",
     ""},
    {"photons: 1000", "deposits: gauss", "23: solver.deposits: is 'gauss', expected", ""},
    {"photons: 1000", "estimator: kernels", "23: solver.estimator: is 'kernels' (did you", ""},
    {"photons: 1000", "estimate_radius: 0", "23: solver.estimate_radius: is '0', expected", ""},
    {"photons: 1000", "irradiance_samples: 1", "23: solver.irradiance_samples: is '1', expec", ""},
    {"photons: 1000", "similarity: maybe", "23: solver.similarity: is 'maybe', expected true", ""},
    {"photons: 1000", "boundary: milen", "23: solver.boundary: is 'milen' (did you mean", ""},
    {"photons: 1000", "divergence: none", "23: solver.divergence: is 'none', expected", ""},
    {"solver:\n", "solver: 3\nsolver2:\n", "22: solver2: unknown key", "'solver'?"},
};

TEST(BadInput, GoodSceneIsGood) {
  const ScratchFolder folder;
  EXPECT_EQ(error_of(folder.write("scene.yaml", good_scene)), "");
}

TEST(BadInput, EveryMistakeIsNamedWithItsPlace) {
  const ScratchFolder folder;
  for (const Mistake& mistake : mistakes) {
    const std::string file =
        folder.write("scene.yaml", replaced(good_scene, mistake.from, mistake.to));
    const std::string error = error_of(file);
    const std::string start = file + ":" + mistake.start;
    EXPECT_EQ(error.substr(0, start.size()), start) << "in full: " << error;
    EXPECT_NE(error.find(mistake.part, file.size()), std::string::npos) << error;
  }
}

TEST(BadInput, MissingParts) {
  const ScratchFolder folder;
  const auto error = [&](const std::string& text) {
    const std::string file = folder.write("scene.yaml", text);
    const std::string message = error_of(file);
    EXPECT_EQ(message.substr(0, file.size() + 1), file + ":");
    return message.substr(std::min(message.size(), file.size() + 1));
  };
  const std::string camera = "camera: {from: [0, -6, 2], to: [0, 0, 0]}\n";
  const std::string materials = "materials: {wax: {type: translucent, sigma_a: 1, sigma_s: 2}}\n";
  const std::string objects = "objects: [{sphere: {radius: 2}, material: wax}]\n";
  EXPECT_EQ(error("units: mm\n").rfind("1: camera: is missing, expected", 0), 0u);
  EXPECT_EQ(error(camera + objects).rfind("1: materials: is missing, expected", 0), 0u);
  EXPECT_EQ(error(camera + materials).rfind("1: objects: is missing, expected", 0), 0u);
  EXPECT_EQ(error(camera + materials + "objects: []\n").rfind("3: objects: is empty", 0), 0u);
  EXPECT_EQ(error(camera + materials + "objects:\n").rfind("3: objects: is empty", 0), 0u);
  EXPECT_EQ(error(camera + materials + objects).rfind("1: lights: nothing shines", 0), 0u);
  EXPECT_EQ(error("lights: []\n" + camera + materials + objects)
                .rfind("1: lights: nothing shines, expected a light or an emission", 0),
            0u);
  EXPECT_EQ(error("lights: [{type: environment, radiance: 0}]\n" + camera + materials + objects)
                .rfind("1: lights: nothing shines", 0),
            0u);
}

TEST(BadInput, FilesThatAreNoScenes) {
  const ScratchFolder folder;
  EXPECT_NE(error_of(folder.path("none.yaml")).find("none.yaml: cannot be opened (No such file"),
            std::string::npos);
  EXPECT_NE(error_of(folder.path("")).find(": is a directory, expected a scene file"),
            std::string::npos);
  for (const char* empty : {"", "\n\n", "# only a comment\n", "---\n", "~"}) {
    EXPECT_NE(error_of(folder.write("scene.yaml", empty)).find("scene.yaml:1: the file is empty"),
              std::string::npos)
        << empty;
  }
  EXPECT_NE(error_of(folder.write("scene.yaml", "just words\n"))
                .find("scene.yaml:1: is 'just words', expected a map with the keys units"),
            std::string::npos);
  EXPECT_NE(error_of(folder.write("scene.yaml", "- 1\n- 2\n")).find("scene.yaml:1: is a list of 2"),
            std::string::npos);
  EXPECT_NE(error_of(folder.write("scene.yaml", std::string("\x7f"
                                                            "ELF\x02\x01\0\0",
                                                            8)))
                .find("scene.yaml:1: contains the byte 0x7f"),
            std::string::npos);
  EXPECT_NE(error_of(folder.write("scene.yaml", std::string(100'000, '['))).find("scene.yaml:1: "),
            std::string::npos);
  EXPECT_NE(error_of(folder.write("scene.yaml", std::string((16u << 20) + 1, 'a')))
                .find("scene.yaml: is larger than 16 MB"),
            std::string::npos);
}

// Ten levels of ten aliases each would be 1e10 nodes.
TEST(BadInput, AliasesThatExplodeAreRefused) {
  const ScratchFolder folder;
  std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 10; ++i) {
    text += fmt::format("a{0}: &a{0} [*a{1}", i, i - 1);
    for (int j = 1; j < 10; ++j) text += fmt::format(", *a{}", i - 1);
    text += "]\n";
  }
  EXPECT_NE(error_of(folder.write("scene.yaml", text)).find("without end"), std::string::npos);
}

// Any beginning of a scene, and a scene with any one byte spoilt, is read or refused; nothing else.
TEST(BadInput, SpoiltFilesNeverCrash) {
  const ScratchFolder folder;
  const std::string text = replaced(good_scene, "{min: [-1, -1, 0], max: [1, 1, 0.5]}",
                                    "{min: [-1, -1, -1], max: [1, 1, 1]}");
  for (std::size_t length = 0; length < text.size(); length += 7) {
    error_of(folder.write("scene.yaml", text.substr(0, length)));
  }
  for (std::size_t i = 0; i < text.size(); i += 5) {
    for (const char c : {'\0', '\xff', '{', '*', ':'}) {
      std::string spoilt = text;
      spoilt[i] = c;
      error_of(folder.write("scene.yaml", spoilt));
    }
  }
}

TEST(BadInput, MistakesInOverrides) {
  struct Case {
    const char* override_text;
    const char* start;
    const char* part;
  };
  const Case cases[] = {
      {"materials.wax.sigma_a=-1", "--set materials.wax.sigma_a: is '-1', expected a number", ""},
      {"camra.fov=3", "--set camra.fov: unknown key 'camra' (did you mean 'camera'?)", ""},
      {"camera.fvo=3", "--set camera.fvo: unknown key 'fvo' (did you mean 'fov'?)", ""},
      {"solver.knot=300", "--set solver.knot: unknown key 'knot' (did you mean 'knots'?)", ""},
      {"lights.9.radiance=3", "--set lights.9.radiance: there is no entry '9'", "below 4"},
      {"objects.bal.scale=3", "--set objects.bal.scale: there is no entry 'bal' (did you mean",
       "'ball'"},
      {"units.x=3", "--set units.x: there is nothing below 'units'", "expected"},
      {"camera.fov", "--set 'camera.fov': has no '=', expected path.to.key=value", ""},
      {"=3", "--set '=3': a step of the path is empty", "expected"},
      {"camera..fov=3", "--set 'camera..fov=3': a step of the path is empty", "expected"},
      {"camera.fov=", "--set camera.fov: there is no value, expected", ""},
      {"camera.fov=[1, 2", "--set camera.fov: not valid YAML", ""},
      {"camera.from=[1, 2]", "--set camera.from: is a list of 2, expected a list of 3", ""},
      {"camera.from=[1, 2, x]", "--set camera.from: camera.from.2: is 'x', expected a number", ""},
      {"camera={to: [1, 2, 3]}", "--set camera: camera.from: is missing", "expected"},
      {"camera.from=null", "", ":2: camera.from: is missing, expected a point"},
      {"solver.exitance=p2", "--set solver.exitance: is 'p2' (did you mean 'p1'?)", "expected"},
  };
  const ScratchFolder folder;
  const std::string file = folder.write("scene.yaml", good_scene);
  for (const Case& c : cases) {
    const std::string error = error_of(file, {c.override_text});
    EXPECT_EQ(error.substr(0, std::string(c.start).size()), c.start) << "in full: " << error;
    EXPECT_NE(error.find(c.part), std::string::npos) << error;
    EXPECT_NE(error, "") << c.override_text;
  }
}

}  // namespace
}  // namespace knotlight
