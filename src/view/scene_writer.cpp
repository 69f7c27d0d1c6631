#include "view/scene_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "pipeline/plan.h"

namespace knotlight {
namespace {

using Kind = YamlNode::Kind;

YamlNode scalar(const std::string& text) {
  YamlNode node;
  node.kind = Kind::scalar;
  node.text = text;
  return node;
}

// The shortest decimal that reads back as the same number.
YamlNode number(double x) {
  return scalar(fmt::format("{}", x));
}

template <class Three>
YamlNode list_of(const Three& v) {
  YamlNode node;
  node.kind = Kind::list;
  for (int i = 0; i < 3; ++i) node.items.push_back(number(v[i]));
  return node;
}

void set(YamlNode& map, const std::string& key, YamlNode value) {
  map.kind = Kind::map;
  if (YamlNode* node = map.find(key)) {
    *node = std::move(value);
    return;
  }
  map.keys.push_back(key);
  map.items.push_back(std::move(value));
}

void remove(YamlNode& map, const std::string& key) {
  const auto found = std::find(map.keys.begin(), map.keys.end(), key);
  if (found == map.keys.end()) return;
  map.items.erase(map.items.begin() + (found - map.keys.begin()));
  map.keys.erase(found);
}

void put_number(YamlNode& map, const std::string& key, double before, double after) {
  if (before != after) set(map, key, number(after));
}

void put_vector(YamlNode& map, const std::string& key, const Vec3& before, const Vec3& after) {
  if (before != after) set(map, key, list_of(after));
}

// One number stays one number as long as the channels agree: [r, g, b] makes three channels.
void put_spectrum(YamlNode& map, const std::string& key, const Spectrum& before,
                  const Spectrum& after) {
  if ((before == after).all()) return;
  const YamlNode* old = map.find(key);
  const bool is_grey = after[0] == after[1] && after[1] == after[2];
  const bool was_list = old != nullptr && old->kind == Kind::list;
  set(map, key, is_grey && !was_list ? number(after[0]) : list_of(after));
}

void put_camera(YamlNode& node, const Camera& before, const Camera& after) {
  put_vector(node, "from", before.from, after.from);
  put_vector(node, "to", before.to, after.to);
  put_number(node, "width", before.width, after.width);
}

void put_light(YamlNode& node, const Light& before, const Light& after) {
  if (const auto* light = std::get_if<PointLight>(&after)) {
    const auto& old = std::get<PointLight>(before);
    put_vector(node, "position", old.position, light->position);
    put_spectrum(node, "intensity", old.intensity, light->intensity);
  } else if (const auto* beam = std::get_if<DirectionalLight>(&after)) {
    const auto& old = std::get<DirectionalLight>(before);
    put_vector(node, "direction", old.direction, beam->direction);
    put_spectrum(node, "irradiance", old.irradiance, beam->irradiance);
  } else if (const auto* area = std::get_if<AreaLight>(&after)) {
    const auto& old = std::get<AreaLight>(before);
    put_vector(node, "center", old.center, area->center);
    put_vector(node, "u", old.u, area->u);
    put_vector(node, "v", old.v, area->v);
    put_spectrum(node, "radiance", old.radiance, area->radiance);
  } else if (const auto* sky = std::get_if<EnvironmentLight>(&after)) {
    put_spectrum(node, "radiance", std::get<EnvironmentLight>(before).radiance, sky->radiance);
  }
}

void put_material(YamlNode& node, const Material& before, const Material& after) {
  if (const auto* wax = std::get_if<TranslucentMaterial>(&after)) {
    const auto& old = std::get<TranslucentMaterial>(before);
    put_spectrum(node, "sigma_a", old.sigma_a, wax->sigma_a);
    put_spectrum(node, "sigma_s", old.sigma_s, wax->sigma_s);
    put_spectrum(node, "g", old.g, wax->g);
    put_number(node, "ior", old.ior, wax->ior);
    put_spectrum(node, "emission", old.emission, wax->emission);
  } else if (const auto* diffuse = std::get_if<DiffuseMaterial>(&after)) {
    put_spectrum(node, "reflectance", std::get<DiffuseMaterial>(before).reflectance,
                 diffuse->reflectance);
  }
}

const char* name_of(Boundary boundary) {
  return boundary == Boundary::milne ? "milne" : "marshak";
}

// Left out = chosen from the scene.
template <class Choice>
void put_choice(YamlNode& map, const std::string& key, const std::optional<Choice>& before,
                const std::optional<Choice>& after) {
  if (before == after) return;
  if (after)
    set(map, key, scalar(name_of(*after)));
  else
    remove(map, key);
}

void put_solver(YamlNode& document, const SolverSettings& before, const SolverSettings& after) {
  YamlNode changed;
  if (const YamlNode* old = document.find("solver")) changed = *old;
  const bool was_empty = changed.items.empty();
  put_number(changed, "tolerance", before.tolerance, after.tolerance);
  put_choice(changed, "source", before.source, after.source);
  put_choice<Method>(changed, "method", before.method, after.method);
  put_choice<Boundary>(changed, "boundary", before.boundary, after.boundary);
  put_choice(changed, "exitance", before.exitance, after.exitance);
  // Left out it would follow the tolerance.
  if (before.photons != after.photons || before.photons_at_most != after.photons_at_most ||
      before.tolerance != after.tolerance)
    set(changed, "photons", scalar(fmt::format("{}", after.photons)));
  if (!was_empty || !changed.items.empty()) set(document, "solver", std::move(changed));
}

bool is_plain(const std::string& text) {
  return !text.empty() && text != "-" && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '+' ||
           c == '.' || c == '/';
  });
}

std::string word(const std::string& text, bool quoted) {
  if (!quoted && is_plain(text)) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == '\t')
      out += "\\t";
    else
      out += c;
  }
  return out + "\"";
}

// In one line.
std::string flow(const YamlNode& node) {
  std::string out;
  switch (node.kind) {
    case Kind::null:
      return "null";
    case Kind::scalar:
      return word(node.text, node.quoted);
    case Kind::list:
      for (const YamlNode& item : node.items) out += (out.empty() ? "" : ", ") + flow(item);
      return "[" + out + "]";
    case Kind::map:
      for (std::size_t i = 0; i < node.items.size(); ++i)
        out += fmt::format("{}{}: {}", i == 0 ? "" : ", ", word(node.keys[i], false),
                           flow(node.items[i]));
      return "{" + out + "}";
  }
  return out;
}

void move_path(YamlNode& node, const std::filesystem::path& from, const std::filesystem::path& to) {
  if (node.kind != Kind::scalar || std::filesystem::path(node.text).is_absolute()) return;
  const std::filesystem::path file =
      std::filesystem::weakly_canonical(std::filesystem::absolute(from) / node.text);
  const std::filesystem::path folder =
      std::filesystem::weakly_canonical(std::filesystem::absolute(to));
  node.text = file.lexically_relative(folder).string();
}

}  // namespace

void put_changes(YamlNode& document, const Scene& before, const Scene& after) {
  put_camera(*document.find("camera"), before.camera, after.camera);
  if (YamlNode* lights = document.find("lights"))
    for (std::size_t i = 0; i < after.lights.size(); ++i)
      put_light(lights->items[i], before.lights[i], after.lights[i]);
  YamlNode& materials = *document.find("materials");
  const YamlNode& objects = *document.find("objects");
  for (std::size_t i = 0; i < after.objects.size(); ++i)
    put_material(*materials.find(objects.items[i].find("material")->text),
                 before.objects[i].material, after.objects[i].material);
  put_solver(document, before.solver, after.solver);
}

void move_paths(YamlNode& document, const std::filesystem::path& from,
                const std::filesystem::path& to) {
  const auto move_in = [&](const char* section, const char* key) {
    YamlNode* list = document.find(section);
    if (list == nullptr) return;
    for (YamlNode& item : list->items)
      if (YamlNode* file = item.find(key)) move_path(*file, from, to);
  };
  move_in("lights", "file");
  move_in("objects", "mesh");
}

std::string yaml_text(const YamlNode& document) {
  std::string text;
  for (std::size_t i = 0; i < document.items.size(); ++i) {
    const YamlNode& section = document.items[i];
    const std::string key = word(document.keys[i], false);
    if (!text.empty()) text += "\n";
    if (section.items.empty()) {
      text += fmt::format("{}: {}\n", key, flow(section));
      continue;
    }
    text += key + ":\n";
    for (std::size_t k = 0; k < section.items.size(); ++k)
      text += fmt::format("  {} {}\n",
                          section.kind == Kind::map ? word(section.keys[k], false) + ":" : "-",
                          flow(section.items[k]));
  }
  return text;
}

std::string leading_comment(const std::string& file) {
  std::ifstream in(file);
  std::string comment;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) comment += line + "\n";
  return comment;
}

}  // namespace knotlight
