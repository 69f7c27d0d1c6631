#include "scene/yaml_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/errors.h"
#include "scene/nearest_name.h"

namespace knotlight {
namespace {

using Kind = YamlNode::Kind;

enum class NumberError { none, not_a_number, not_finite, out_of_range };

struct ParsedNumber {
  double value = 0.0;
  NumberError error = NumberError::none;
};

// from_chars is independent of the locale and says where it stopped. It lacks a leading '+' and
// YAML's spelling of infinities.
ParsedNumber parse_number(const YamlNode& node) {
  if (node.kind != Kind::scalar || node.quoted) return {0.0, NumberError::not_a_number};
  std::string text = node.text;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.erase(0, 1);
  if (text == ".nan" || text == ".inf" || text == "-.inf") return {0.0, NumberError::not_finite};
  ParsedNumber parsed;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed.value);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) {
    parsed.error = NumberError::not_a_number;
  } else if (error == std::errc::result_out_of_range) {
    parsed.error = NumberError::out_of_range;
  } else if (!std::isfinite(parsed.value)) {
    parsed.error = NumberError::not_finite;
  }
  return parsed;
}

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case Kind::null:
      return "is empty";
    case Kind::scalar:
      return fmt::format("is {}{}", node.quoted ? "the text " : "", quote(node.text));
    case Kind::list:
      return fmt::format("is a list of {}", node.items.size());
    case Kind::map:
      return "is a map";
  }
  return "";
}

std::string describe(const Range& range) {
  std::string text;
  if (std::isfinite(range.min)) {
    text += fmt::format(" {} {:g}", range.open_min ? ">" : ">=", range.min);
  }
  if (std::isfinite(range.max)) {
    text += fmt::format("{} {} {:g}", text.empty() ? "" : " and",
                        range.open_max ? "<" : "<=", range.max);
  }
  return text;
}

bool contains(const Range& range, double x) {
  return (range.open_min ? x > range.min : x >= range.min) &&
         (range.open_max ? x < range.max : x <= range.max);
}

}  // namespace

void fail(const YamlNode& node, const std::string& what) {
  throw InputError(node.where() + what);
}

void check_keys(const YamlNode& node, const std::vector<std::string>& valid) {
  if (node.kind != Kind::map && node.kind != Kind::null) {
    fail(node, fmt::format("{}, expected a map with the keys {}", describe(node), one_of(valid)));
  }
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const std::string& key = node.keys[i];
    if (std::find(valid.begin(), valid.end(), key) != valid.end()) continue;
    fail(node.items[i], fmt::format("unknown key {}{}, expected {}", quote(key),
                                    did_you_mean(key, valid), one_of(valid)));
  }
}

const YamlNode& require(const YamlNode& map, const std::string& key, const std::string& expected) {
  if (const YamlNode* value = map.find(key)) return *value;
  const std::string path = map.path.empty() ? key : map.path + "." + key;
  throw InputError(fmt::format("{}: {}: is missing, expected {}", map.origin, path, expected));
}

void check_list(const YamlNode& node, const std::string& expected) {
  if (node.kind != Kind::list) fail(node, describe(node) + ", expected " + expected);
}

double read_number(const YamlNode& node, const Range& range) {
  const std::string expected = ", expected a number" + describe(range);
  const ParsedNumber number = parse_number(node);
  switch (number.error) {
    case NumberError::not_a_number:
      fail(node, describe(node) + expected);
    case NumberError::not_finite:
      fail(node, describe(node) + ", which is not finite" + expected);
    case NumberError::out_of_range:
      fail(node, describe(node) + ", beyond double precision" + expected);
    case NumberError::none:
      break;
  }
  if (!contains(range, number.value)) fail(node, describe(node) + expected);
  return number.value;
}

std::size_t read_count(const YamlNode& node, std::size_t min, std::size_t max) {
  const ParsedNumber number = parse_number(node);
  const bool fits = number.error == NumberError::none && number.value == std::floor(number.value) &&
                    number.value >= static_cast<double>(min) &&
                    number.value <= static_cast<double>(max);
  if (!fits) {
    fail(node, fmt::format("{}, expected a whole number from {} to {}", describe(node), min, max));
  }
  return static_cast<std::size_t>(number.value);
}

bool read_bool(const YamlNode& node) {
  if (node.kind == Kind::scalar && !node.quoted) {
    if (node.text == "true") return true;
    if (node.text == "false") return false;
  }
  fail(node, describe(node) + ", expected true or false");
}

std::string read_text(const YamlNode& node, const std::string& expected) {
  const bool looks_typed = !node.quoted && (node.text == "true" || node.text == "false" ||
                                            parse_number(node).error != NumberError::not_a_number);
  const bool is_printable = std::none_of(node.text.begin(), node.text.end(),
                                         [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (node.kind != Kind::scalar || node.text.empty() || looks_typed || !is_printable) {
    fail(node, describe(node) + ", expected " + expected);
  }
  return node.text;
}

Vec3 read_vec3(const YamlNode& node, const Range& range) {
  if (node.kind != Kind::list || node.items.size() != 3) {
    fail(node, describe(node) + ", expected a list of 3 numbers [x, y, z]");
  }
  Vec3 v;
  for (int i = 0; i < 3; ++i) v[i] = read_number(node.items[static_cast<std::size_t>(i)], range);
  return v;
}

Spectrum read_spectrum(const YamlNode& node, const Range& range, bool& coloured) {
  if (node.kind == Kind::scalar) return Spectrum::Constant(read_number(node, range));
  if (node.kind != Kind::list || node.items.size() != 3) {
    fail(node, fmt::format("{}, expected a number{} or a list of 3 such [r, g, b]", describe(node),
                           describe(range)));
  }
  coloured = true;
  Spectrum s;
  for (int i = 0; i < 3; ++i) s[i] = read_number(node.items[static_cast<std::size_t>(i)], range);
  return s;
}

std::size_t read_choice(const YamlNode& node, const std::vector<std::string>& names,
                        const std::vector<bool>& available) {
  std::vector<std::string> usable;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (available[i]) usable.push_back(names[i]);
  }
  const std::string expected = ", expected " + one_of(usable);
  if (node.kind != Kind::scalar) fail(node, describe(node) + expected);
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found == names.end()) {
    fail(node, describe(node) + did_you_mean(node.text, usable) + expected);
  }
  const auto index = static_cast<std::size_t>(found - names.begin());
  if (!available[index]) {
    fail(node, describe(node) + ", which is not available in this version" + expected);
  }
  return index;
}

}  // namespace knotlight
