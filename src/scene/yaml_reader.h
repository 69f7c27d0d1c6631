// A YAML file as a plain tree in which every node knows where it was written, so that every later
// complaint can name file, line and key. yaml-cpp stays inside yaml_reader.cpp.
#pragma once

#include <string>
#include <vector>

namespace knotlight {

struct YamlNode {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  std::string text;               // of a scalar
  bool quoted = false;            // a quoted scalar is text, whatever it looks like
  std::vector<YamlNode> items;    // of a list, or the values of a map
  std::vector<std::string> keys;  // of a map, one per item

  std::string origin;  // "file:line", or "--set path.to.key" for what an override brought in
  std::string path;    // dotted, as in --set; empty for the root
  bool path_in_origin = false;  // the origin already says which key (the target of an override)

  // "file:line: path.to.key: ", the beginning of a message about this node.
  std::string where() const;
  // The value of a map's key, or null.
  const YamlNode* find(const std::string& key) const;
  YamlNode* find(const std::string& key);
  // The name of list item i in paths: its `name` if it has one, else its number.
  std::string item_name(std::size_t i) const;
};

// Reads the one document of the file. Aliases are expanded. Throws InputError for a file that is
// missing, a directory, empty, too large or not text, for YAML errors, and for a key given twice.
YamlNode read_yaml(const std::string& file);

// Parses a value given on the command line; every node of it gets `origin`. Same errors.
YamlNode parse_yaml_value(const std::string& text, const std::string& origin);

// Fills in `path` from `root` (whose own path is empty) downwards.
void assign_paths(YamlNode& root);

// `text` in single quotes, shortened, with everything unprintable replaced: fit for one line.
std::string quote(const std::string& text);

}  // namespace knotlight
