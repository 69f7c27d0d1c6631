#include <algorithm>
#include <array>

#include "core/errors.h"
#include "core/image_io.h"
#include "scene/scene_parts.h"

namespace knotlight {
namespace {

enum class LightType { point, directional, area, environment };

constexpr std::array<Choice<LightType>, 4> light_types{{
    {"point", LightType::point},
    {"directional", LightType::directional},
    {"area", LightType::area},
    {"environment", LightType::environment},
}};

// Sine of the angle between u and v below which their parallelogram counts as a line: its normal
// would have lost most of its digits.
constexpr double min_sine_parallelogram = 1e-9;

PointLight read_point(const YamlNode& node, SceneContext& context) {
  check_keys(node, {"type", "position", "intensity"});
  PointLight light;
  light.position = read_vec3(require(node, "position", "a point [x, y, z]"), any_position);
  light.intensity = read_spectrum(require(node, "intensity", "W/sr"), any_power, context.coloured);
  return light;
}

DirectionalLight read_directional(const YamlNode& node, SceneContext& context) {
  check_keys(node, {"type", "direction", "irradiance"});
  DirectionalLight light;
  const YamlNode& direction = require(node, "direction", "the direction of travel [x, y, z]");
  light.direction = read_vec3(direction, any_position);
  if (light.direction.norm() < min_length) fail(direction, "has no length, expected a direction");
  light.direction.normalize();
  light.irradiance = read_spectrum(require(node, "irradiance", "W per area normal to it"),
                                   any_power, context.coloured);
  return light;
}

AreaLight read_area(const YamlNode& node, SceneContext& context) {
  check_keys(node, {"type", "center", "u", "v", "radiance"});
  AreaLight light;
  light.center = read_vec3(require(node, "center", "a point [x, y, z]"), any_position);
  light.u = read_vec3(require(node, "u", "a half-edge [x, y, z]"), any_position);
  light.v = read_vec3(require(node, "v", "a half-edge [x, y, z]"), any_position);
  check_parallelogram(node, light.u, light.v);
  light.radiance =
      read_spectrum(require(node, "radiance", "W/(area sr)"), any_power, context.coloured);
  return light;
}

std::shared_ptr<const EnvironmentMap> read_map(const YamlNode& node, SceneContext& context) {
  const std::string file = read_text(node, "the name of a picture (latitude-longitude layout)");
  Image image;
  try {
    image = read_image(context.resolve(file));
  } catch (const InputError& error) {
    fail(node, error.what());
  }
  const bool is_black = std::all_of(image.pixels.begin(), image.pixels.end(),
                                    [](const Spectrum& p) { return (p == 0.0).all(); });
  if (is_black) fail(node, "is black everywhere, expected a picture that shines");
  const bool is_grey = std::all_of(image.pixels.begin(), image.pixels.end(),
                                   [](const Spectrum& p) { return p[0] == p[1] && p[1] == p[2]; });
  if (!is_grey) context.coloured = true;
  return std::make_shared<EnvironmentMap>(image.width, image.height, std::move(image.pixels));
}

EnvironmentLight read_environment(const YamlNode& node, SceneContext& context) {
  check_keys(node, {"type", "radiance", "file"});
  EnvironmentLight light;
  const YamlNode* file = node.find("file");
  if (file != nullptr) light.map = read_map(*file, context);
  light.radiance = Spectrum::Ones();
  const YamlNode* radiance = node.find("radiance");
  if (radiance == nullptr && file == nullptr) {
    require(node, "radiance", "W/(area sr), or a file");
  }
  if (radiance != nullptr) light.radiance = read_spectrum(*radiance, any_power, context.coloured);
  return light;
}

Light read_light(const YamlNode& node, SceneContext& context) {
  if (node.kind != YamlNode::Kind::map) {
    fail(node, "is not a map, expected {type: point, ...} or another light");
  }
  const YamlNode& type = require(node, "type", "point, directional, area or environment");
  switch (read_choice(type, light_types)) {
    case LightType::point:
      return read_point(node, context);
    case LightType::directional:
      return read_directional(node, context);
    case LightType::area:
      return read_area(node, context);
    case LightType::environment:
      return read_environment(node, context);
  }
  fail(type, "is not a light");
}

}  // namespace

std::vector<Light> read_lights(const YamlNode& node, SceneContext& context) {
  check_list(node, "a list of lights");
  std::vector<Light> lights;
  for (const YamlNode& item : node.items) lights.push_back(read_light(item, context));
  return lights;
}

void check_parallelogram(const YamlNode& node, const Vec3& u, const Vec3& v) {
  const bool has_area = u.norm() >= min_length && v.norm() >= min_length &&
                        u.normalized().cross(v.normalized()).norm() >= min_sine_parallelogram;
  if (!has_area) fail(node, "u and v span no area, expected two half-edges that do");
}

}  // namespace knotlight
