#include <fmt/format.h>

#include <set>

#include "core/errors.h"
#include "core/units.h"
#include "scene/mesh_reader.h"
#include "scene/nearest_name.h"
#include "scene/scene_parts.h"

namespace knotlight {
namespace {

// The solved field is interpolated between the vertices of a translucent object, so its edges must
// be short against its size. A box starts from 12 triangles and needs more than a modelled mesh.
constexpr double box_edges_per_extent = 64.0;
constexpr double mesh_edges_per_extent = 32.0;

constexpr Range any_angle{-1e6, 1e6};  // degrees; beyond, sine and cosine lose the digits given

// x -> rotation (scale x) + translation
struct Similarity {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 operator()(const Vec3& x) const { return rotation * (scale * x) + translation; }
};

Similarity read_similarity(const YamlNode& node) {
  Similarity similarity;
  if (const YamlNode* scale = node.find("scale")) {
    if (scale->kind == YamlNode::Kind::list) {
      fail(*scale, "is a list, expected one number > 0 for all three axes");
    }
    similarity.scale = read_number(*scale, any_length);
  }
  if (const YamlNode* rotate = node.find("rotate")) {
    const Vec3 angles = read_vec3(*rotate, any_angle);
    similarity.rotation = (Eigen::AngleAxisd(radians(angles.z()), Vec3::UnitZ()) *
                           Eigen::AngleAxisd(radians(angles.y()), Vec3::UnitY()) *
                           Eigen::AngleAxisd(radians(angles.x()), Vec3::UnitX()))
                              .toRotationMatrix();
  }
  if (const YamlNode* translate = node.find("translate")) {
    similarity.translation = read_vec3(*translate, any_position);
  }
  return similarity;
}

TriangleMesh transformed(TriangleMesh mesh, const Similarity& similarity) {
  for (Vec3& vertex : mesh.vertices) vertex = similarity(vertex);
  return mesh;
}

Shape read_sphere(const YamlNode& node, const Similarity& similarity) {
  check_keys(node, {"center", "radius"});
  Sphere sphere;
  if (const YamlNode* center = node.find("center")) {
    sphere.center = read_vec3(*center, any_position);
  }
  sphere.radius = read_number(require(node, "radius", "a length"), any_length);
  return Sphere{similarity(sphere.center), similarity.scale * sphere.radius};
}

Shape read_box(const YamlNode& node, const Similarity& similarity, bool is_translucent) {
  check_keys(node, {"min", "max"});
  const YamlNode& max = require(node, "max", "a corner [x, y, z]");
  const Vec3 lo = read_vec3(require(node, "min", "a corner [x, y, z]"), any_position);
  const Vec3 hi = read_vec3(max, any_position);
  if (((hi - lo).array() < min_length).any()) {
    fail(max, "is not beyond min on every axis, expected min < max");
  }
  TriangleMesh mesh = box_mesh(lo, hi);
  if (is_translucent) {
    const double extent = (hi - lo).maxCoeff();
    mesh = refine(std::move(mesh), extent / box_edges_per_extent);
  }
  return transformed(std::move(mesh), similarity);
}

Shape read_quad(const YamlNode& node, const Similarity& similarity, bool is_translucent) {
  check_keys(node, {"center", "u", "v"});
  if (is_translucent) {
    fail(node, "is not closed and so can't be translucent, expected a diffuse material or a box");
  }
  const Vec3 center = read_vec3(require(node, "center", "a point [x, y, z]"), any_position);
  const Vec3 u = read_vec3(require(node, "u", "a half-edge [x, y, z]"), any_position);
  const Vec3 v = read_vec3(require(node, "v", "a half-edge [x, y, z]"), any_position);
  check_parallelogram(node, u, v);
  return transformed(quad_mesh(center, u, v), similarity);
}

Shape read_mesh_object(const YamlNode& node, const Similarity& similarity, bool is_translucent,
                       SceneContext& context) {
  const std::string file = context.resolve(read_text(node, "the name of a mesh file"));
  try {
    TriangleMesh mesh = read_mesh(file);
    if (is_translucent) {
      std::vector<std::string> warnings;
      mesh = make_solid(std::move(mesh), warnings);
      for (const std::string& warning : warnings)
        context.warnings.push_back(node.where() + warning);
      const double extent = bounds(mesh).largest_extent();
      mesh = refine(std::move(mesh), extent / mesh_edges_per_extent);
    }
    for (const Spectrum& colour : mesh.colours)
      if (colour[0] != colour[1] || colour[1] != colour[2]) context.coloured = true;
    return transformed(std::move(mesh), similarity);
  } catch (const InputError& error) {
    fail(node, error.what());
  }
}

const Material& find_material(const YamlNode& node,
                              const std::map<std::string, Material>& materials) {
  const std::string name = read_text(node, "the name of a material");
  const auto found = materials.find(name);
  if (found != materials.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : materials) names.push_back(entry.first);
  fail(node,
       fmt::format("there is no material {}{}, expected {}", quote(name), did_you_mean(name, names),
                   names.empty() ? "one under `materials`" : one_of(names)));
}

// The one key of the object that says what it is.
const YamlNode& find_shape(const YamlNode& node, std::string& kind) {
  const YamlNode* shape = nullptr;
  for (const char* key : {"mesh", "sphere", "box", "quad"}) {
    const YamlNode* candidate = node.find(key);
    if (candidate == nullptr) continue;
    if (shape != nullptr) {
      fail(*candidate, fmt::format("is a second shape besides {}, expected one of mesh, sphere, "
                                   "box, quad",
                                   kind));
    }
    shape = candidate;
    kind = key;
  }
  if (shape == nullptr) fail(node, "has no shape, expected one of mesh, sphere, box, quad");
  return *shape;
}

// Placed out of the range of the numbers the ray caster works with?
void check_placement(const YamlNode& node, const Shape& shape) {
  const Bounds box = bounds(shape);
  const bool is_near =
      (box.lo.array() >= -max_length).all() && (box.hi.array() <= max_length).all();
  if (!is_near || box.largest_extent() < min_length) {
    fail(node, fmt::format("is too large, too small or too far away once scaled and moved, "
                           "expected sizes from {:g} and coordinates up to {:g}",
                           min_length, max_length));
  }
}

Object read_object(const YamlNode& node, std::size_t index,
                   const std::map<std::string, Material>& materials, SceneContext& context) {
  check_keys(node,
             {"name", "mesh", "sphere", "box", "quad", "material", "scale", "rotate", "translate"});
  Object object;
  const YamlNode* name = node.find("name");
  object.name = name != nullptr ? read_text(*name, "a name") : fmt::format("object{}", index);
  std::string kind;
  const YamlNode& shape = find_shape(node, kind);
  object.material = find_material(require(node, "material", "the name of a material"), materials);
  const bool is_translucent = object.translucent() != nullptr;
  const Similarity similarity = read_similarity(node);
  if (kind == "mesh") {
    object.shape = read_mesh_object(shape, similarity, is_translucent, context);
  } else if (kind == "sphere") {
    object.shape = read_sphere(shape, similarity);
  } else if (kind == "box") {
    object.shape = read_box(shape, similarity, is_translucent);
  } else {
    object.shape = read_quad(shape, similarity, is_translucent);
  }
  check_placement(shape, object.shape);
  return object;
}

}  // namespace

std::vector<Object> read_objects(const YamlNode& node,
                                 const std::map<std::string, Material>& materials,
                                 SceneContext& context) {
  check_list(node, "a list of objects");
  if (node.items.empty()) fail(node, "is empty, expected at least one object");
  std::vector<Object> objects;
  std::set<std::string> names;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    objects.push_back(read_object(node.items[i], i, materials, context));
    const std::string& name = objects.back().name;
    if (!names.insert(name).second) {
      fail(node.items[i],
           fmt::format("there is another object {}, expected names that differ", quote(name)));
    }
  }
  return objects;
}

}  // namespace knotlight
