#include <algorithm>
#include <array>

#include "scene/scene_parts.h"

namespace knotlight {
namespace {

constexpr std::array<Choice<Camera::Type>, 2> camera_types{{
    {"perspective", Camera::Type::perspective},
    {"orthographic", Camera::Type::orthographic},
}};

constexpr std::size_t max_resolution = 65536;  // per side; more is a slip of the keyboard
constexpr std::size_t max_samples = 1'000'000;
// Sine of the angle between `up` and the line of sight below which their cross product is mostly
// rounding: 1e-6 leaves ten digits.
constexpr double min_sine_up = 1e-6;
// `from` and `to` this near, relative to their size, have no direction that double precision knows.
constexpr double min_relative_distance = 1e-12;

void read_resolution(const YamlNode& node, Camera& camera) {
  check_list(node, "[width, height] in pixels");
  if (node.items.size() != 2) fail(node, "does not have 2 entries, expected [width, height]");
  camera.width_px = static_cast<int>(read_count(node.items[0], 1, max_resolution));
  camera.height_px = static_cast<int>(read_count(node.items[1], 1, max_resolution));
}

}  // namespace

Camera read_camera(const YamlNode& node) {
  Camera camera;
  check_keys(node, {"type", "from", "to", "up", "fov", "width", "resolution", "samples"});
  if (const YamlNode* type = node.find("type")) camera.type = read_choice(*type, camera_types);
  const bool is_perspective = camera.type == Camera::Type::perspective;
  const char* wrong_key = is_perspective ? "width" : "fov";
  if (const YamlNode* extra = node.find(wrong_key)) {
    fail(*extra, is_perspective ? "belongs to an orthographic camera, expected fov (degrees)"
                                : "belongs to a perspective camera, expected width (length)");
  }
  const YamlNode& to = require(node, "to", "a point [x, y, z] to look at");
  camera.from = read_vec3(require(node, "from", "a point [x, y, z]"), any_position);
  camera.to = read_vec3(to, any_position);
  camera.up = Vec3::UnitZ();
  const YamlNode* up = node.find("up");
  if (up != nullptr) camera.up = read_vec3(*up, any_position);
  if (const YamlNode* fov = node.find("fov")) {
    camera.fov = read_number(*fov, {0.0, 180.0, true, true});
  }
  if (!is_perspective) {
    camera.width =
        read_number(require(node, "width", "the width of the picture (length)"), any_length);
  }
  if (const YamlNode* resolution = node.find("resolution")) read_resolution(*resolution, camera);
  if (const YamlNode* samples = node.find("samples")) {
    camera.samples = static_cast<int>(read_count(*samples, 1, max_samples));
  }

  const Vec3 view = camera.to - camera.from;
  const double size = std::max({camera.from.norm(), camera.to.norm(), min_length});
  if (view.norm() <= min_relative_distance * size) {
    fail(to, "is the same point as camera.from, expected another");
  }
  const YamlNode& up_place = up != nullptr ? *up : to;
  if (camera.up.norm() < min_length) fail(up_place, "has no length, expected a direction");
  if (camera.up.normalized().cross(view.normalized()).norm() < min_sine_up) {
    fail(up_place, up != nullptr ? "is parallel to the line of sight, expected another direction"
                                 : "is straight above or below camera.from, expected an `up` other "
                                   "than the default [0, 0, 1]");
  }
  camera.up.normalize();
  return camera;
}

}  // namespace knotlight
