// Typed, checked access to the nodes of a YAML tree. Everything wrong throws InputError
// "file:line: path.to.key: what is wrong, expected ...".
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "scene/yaml_reader.h"

namespace knotlight {

// An interval of numbers; open ends exclude the number itself.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  bool open_max = false;
};
inline constexpr Range between_0_and_1{0.0, 1.0, true, true};

[[noreturn]] void fail(const YamlNode& node, const std::string& what);

// The node is a map and has no keys but these. Null counts as an empty map.
void check_keys(const YamlNode& node, const std::vector<std::string>& valid);
// The value of a key that must be there.
const YamlNode& require(const YamlNode& map, const std::string& key, const std::string& expected);
// The node is a list.
void check_list(const YamlNode& node, const std::string& expected);

// Finite numbers in decimal notation; whole text, no unit behind.
double read_number(const YamlNode& node, const Range& range);
// A number without fraction, 1e6 included; both ends of the range belong to it.
std::size_t read_count(const YamlNode& node, std::size_t min, std::size_t max);
bool read_bool(const YamlNode& node);
// Non-empty text; a number or truth value must be quoted to pass for text.
std::string read_text(const YamlNode& node, const std::string& expected);
// [x, y, z], each in the range.
Vec3 read_vec3(const YamlNode& node, const Range& range);
// One number for all channels, or [r, g, b], which sets `coloured`.
Spectrum read_spectrum(const YamlNode& node, const Range& range, bool& coloured);

// One word of a table. A word may be part of the format and yet not be available in this version;
// then it is refused with a message that says so.
template <class T>
struct Choice {
  const char* name;
  T value;
  bool available = true;
};

std::size_t read_choice(const YamlNode& node, const std::vector<std::string>& names,
                        const std::vector<bool>& available);

template <class T, std::size_t N>
T read_choice(const YamlNode& node, const std::array<Choice<T>, N>& table) {
  std::vector<std::string> names;
  std::vector<bool> available;
  for (const Choice<T>& choice : table) {
    names.emplace_back(choice.name);
    available.push_back(choice.available);
  }
  return table[read_choice(node, names, available)].value;
}

}  // namespace knotlight
