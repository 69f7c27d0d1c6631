#include <fmt/format.h>

#include <array>

#include "scene/scene_parts.h"

namespace knotlight {
namespace {

enum class MaterialType { translucent, diffuse };

constexpr std::array<Choice<MaterialType>, 2> material_types{{
    {"translucent", MaterialType::translucent},
    {"diffuse", MaterialType::diffuse},
}};

constexpr Range coefficient{0.0, 1e12};  // 1/length; the inverse of the smallest length
constexpr Range mean_cosine{-1.0, 1.0, true, true};
constexpr Range refractive_index{1.0, 10.0};  // no transparent matter comes near 10

TranslucentMaterial read_translucent(const YamlNode& node, SceneContext& context) {
  check_keys(node, {"type", "sigma_a", "sigma_s", "g", "ior", "emission", "roughness"});
  TranslucentMaterial material;
  material.sigma_a = read_spectrum(require(node, "sigma_a", "the absorption (1/length)"),
                                   coefficient, context.coloured);
  material.sigma_s = read_spectrum(require(node, "sigma_s", "the scattering (1/length)"),
                                   coefficient, context.coloured);
  if (const YamlNode* g = node.find("g")) {
    material.g = read_spectrum(*g, mean_cosine, context.coloured);
  }
  if (const YamlNode* ior = node.find("ior")) material.ior = read_number(*ior, refractive_index);
  if (const YamlNode* emission = node.find("emission")) {
    material.emission = read_spectrum(*emission, any_power, context.coloured);
  }
  if (const YamlNode* roughness = node.find("roughness"))
    material.roughness = read_number(*roughness, {0.0, 1.0});
  for (int c = 0; c < 3; ++c) {
    if (material.sigma_a[c] + material.sigma_s[c] <= 0.0) {
      fail(node, fmt::format("sigma_a + sigma_s is 0 in channel {}, expected > 0: the diffusion "
                             "equation needs matter",
                             c));
    }
  }
  return material;
}

DiffuseMaterial read_diffuse(const YamlNode& node, SceneContext& context) {
  check_keys(node, {"type", "reflectance"});
  return {read_spectrum(require(node, "reflectance", "a number from 0 to 1"), {0.0, 1.0},
                        context.coloured)};
}

Material read_material(const YamlNode& node, SceneContext& context) {
  if (node.kind != YamlNode::Kind::map) {
    fail(node, "is not a map, expected {type: translucent, ...} or {type: diffuse, ...}");
  }
  const YamlNode& type = require(node, "type", "translucent or diffuse");
  if (read_choice(type, material_types) == MaterialType::translucent) {
    return read_translucent(node, context);
  }
  return read_diffuse(node, context);
}

}  // namespace

std::map<std::string, Material> read_materials(const YamlNode& node, SceneContext& context) {
  if (node.kind != YamlNode::Kind::map) fail(node, "is not a map, expected `name: {type: ...}`");
  std::map<std::string, Material> materials;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    materials.emplace(node.keys[i], read_material(node.items[i], context));
  }
  return materials;
}

}  // namespace knotlight
