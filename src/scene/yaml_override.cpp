#include "scene/yaml_override.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/errors.h"
#include "scene/nearest_name.h"

namespace knotlight {
namespace {

std::vector<std::string> split_at_dots(const std::string& path) {
  std::vector<std::string> steps;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1) {
    steps.push_back(path.substr(begin, dot - begin));
  }
  steps.push_back(path.substr(begin));
  return steps;
}

std::size_t item_index(const YamlNode& list, const std::string& step, const std::string& origin) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error == std::errc() && end == step.data() + step.size()) {
    if (index < list.items.size()) return index;
    throw InputError(fmt::format("{}: there is no entry {}, expected a number below {}", origin,
                                 quote(step), list.items.size()));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    names.push_back(list.item_name(i));
    if (names.back() == step) return i;
  }
  throw InputError(fmt::format("{}: there is no entry {}{}, expected {}", origin, quote(step),
                               did_you_mean(step, names), one_of(names)));
}

}  // namespace

void apply_override(YamlNode& root, const std::string& override_text) {
  const std::size_t equals = override_text.find('=');
  if (equals == std::string::npos) {
    throw InputError(
        fmt::format("--set {}: has no '=', expected path.to.key=value", quote(override_text)));
  }
  const std::string path = override_text.substr(0, equals);
  const std::string origin = "--set " + path;
  const std::vector<std::string> steps = split_at_dots(path);
  if (std::find(steps.begin(), steps.end(), "") != steps.end()) {
    throw InputError(fmt::format(
        "--set {}: a step of the path is empty, expected path.to.key=value", quote(override_text)));
  }
  const std::string text = override_text.substr(equals + 1);
  if (text.empty()) throw InputError(origin + ": there is no value, expected path.to.key=value");

  YamlNode value = parse_yaml_value(text, origin);
  value.path_in_origin = true;

  YamlNode* node = &root;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is_last = i + 1 == steps.size();
    if (node->kind == YamlNode::Kind::list) {
      node = &node->items[item_index(*node, steps[i], origin)];
      continue;
    }
    if (node->kind == YamlNode::Kind::null) node->kind = YamlNode::Kind::map;
    if (node->kind != YamlNode::Kind::map) {
      throw InputError(fmt::format("{}: there is nothing below {}, expected the path of a key",
                                   origin, quote(steps[i - 1])));
    }
    const auto key = std::find(node->keys.begin(), node->keys.end(), steps[i]);
    const auto position = key - node->keys.begin();
    if (is_last && value.kind == YamlNode::Kind::null) {
      if (key == node->keys.end()) return;
      node->keys.erase(key);
      node->items.erase(node->items.begin() + position);
      return;
    }
    if (key == node->keys.end()) {
      node->keys.push_back(steps[i]);
      YamlNode& created = node->items.emplace_back();
      created.origin = origin;
      created.path_in_origin = true;
    }
    node = &node->items[static_cast<std::size_t>(position)];
  }
  *node = std::move(value);
}

}  // namespace knotlight
