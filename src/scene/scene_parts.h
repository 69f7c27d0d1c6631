// The readers of the parts of a scene, one source file each; scene_reader.cpp puts them together.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/yaml_values.h"

namespace knotlight {

// What the parts tell each other while a scene is read.
struct SceneContext {
  std::filesystem::path folder;       // of the scene file; other files are relative to it
  bool coloured = false;              // some coefficient or light was given as [r, g, b]
  std::vector<std::string> warnings;  // one line each

  std::string resolve(const std::string& file) const { return (folder / file).string(); }
};

// Positions and sizes (length). The ray caster squares lengths in single precision, whose range
// ends at 1e38 and 1e-38.
constexpr double max_length = 1e12;
constexpr double min_length = 1e-12;
constexpr Range any_position{-max_length, max_length};
constexpr Range any_length{min_length, max_length};
// Radiometric quantities end up in single precision pictures, with room for sums and squares.
constexpr Range any_power{0.0, 1e15};

Camera read_camera(const YamlNode& node);
std::vector<Light> read_lights(const YamlNode& node, SceneContext& context);
std::map<std::string, Material> read_materials(const YamlNode& node, SceneContext& context);
std::vector<Object> read_objects(const YamlNode& node,
                                 const std::map<std::string, Material>& materials,
                                 SceneContext& context);
SolverSettings read_solver(const YamlNode& node);
// Of the solver section; bkm_thesis_keys are those it reads.
extern const std::vector<std::string> bkm_thesis_keys;
BkmThesisSettings read_bkm_thesis(const YamlNode& solver);

// Half-edges u, v of a parallelogram: throws at `node` if they span no area.
void check_parallelogram(const YamlNode& node, const Vec3& u, const Vec3& v);

}  // namespace knotlight
