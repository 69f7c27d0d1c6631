#include "scene/yaml_reader.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "core/errors.h"

namespace knotlight {
namespace {

// A scene is typed by hand; anything this large is another kind of file (or a device without end).
constexpr std::size_t max_file_bytes = 16u << 20;
// The format is at most 4 levels deep; the limit stops aliases that contain themselves.
constexpr int max_depth = 32;
// Aliases of aliases can grow exponentially; no real scene comes near this.
constexpr std::size_t max_nodes = 1'000'000;
// What is quoted in a message is cut here so that the line stays readable.
constexpr std::size_t max_quoted_bytes = 48;

using OriginOfLine = std::function<std::string(int line)>;

std::string read_text(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw InputError(file + ": is a directory, expected a scene file (YAML)");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw InputError(fmt::format("{}: cannot be opened ({}), expected a scene file (YAML)", file,
                                 std::strerror(errno)));
  }
  std::string text;
  char buffer[1 << 16];
  while (in.read(buffer, sizeof buffer), in.gcount() > 0) {
    text.append(buffer, static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_file_bytes) {
      throw InputError(fmt::format("{}: is larger than {} MB, expected a scene file (YAML)", file,
                                   max_file_bytes >> 20));
    }
  }
  return text;
}

// yaml-cpp takes some binary files for one long scalar; say what is the matter instead.
void refuse_binary(const std::string& text, const OriginOfLine& origin) {
  int line = 1;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_text = byte >= 0x20 || c == '\n' || c == '\r' || c == '\t';
    if (!is_text || byte == 0x7f) {
      throw InputError(fmt::format("{}: contains the byte 0x{:02x}, expected a text file (YAML)",
                                   origin(line), byte));
    }
    if (c == '\n') ++line;
  }
}

// True if the indentation of line `number` (from 1) contains a tab.
bool is_indented_by_tab(const std::string& text, int number) {
  std::size_t begin = 0;
  for (int line = 1; line < number && begin != std::string::npos; ++line) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos) return false;
  const std::size_t end = std::min(text.find_first_not_of(" \t", begin), text.size());
  return text.substr(begin, end - begin).find('\t') != std::string::npos;
}

class Converter {
 public:
  explicit Converter(OriginOfLine origin) : origin_(std::move(origin)) {}

  YamlNode convert(const YAML::Node& source, int line, int depth = 0) {
    YamlNode node;
    node.origin = origin_(line);
    if (depth > max_depth || ++nodes_ > max_nodes) {
      throw InputError(node.origin +
                       ": is nested too deeply or without end, expected a scene (YAML)");
    }
    switch (source.Type()) {
      case YAML::NodeType::Undefined:
      case YAML::NodeType::Null:
        break;
      case YAML::NodeType::Scalar:
        node.kind = YamlNode::Kind::scalar;
        node.text = source.Scalar();
        node.quoted = source.Tag() == "!";
        break;
      case YAML::NodeType::Sequence:
        node.kind = YamlNode::Kind::list;
        for (const YAML::Node& item : source) {
          node.items.push_back(convert(item, item.Mark().line + 1, depth + 1));
        }
        break;
      case YAML::NodeType::Map:
        convert_map(source, node, depth);
        break;
    }
    return node;
  }

 private:
  // A value carries the line of its key: that is where one looks for `camera:`.
  void convert_map(const YAML::Node& source, YamlNode& node, int depth) {
    node.kind = YamlNode::Kind::map;
    for (const auto& entry : source) {
      const int line = entry.first.Mark().line + 1;
      if (!entry.first.IsScalar()) {
        throw InputError(origin_(line) + ": a key is not a word, expected `key: value`");
      }
      const std::string& key = entry.first.Scalar();
      if (const YamlNode* first = node.find(key)) {
        throw InputError(fmt::format("{}: {}: the key is given twice (first at {}), expected once",
                                     origin_(line), quote(key), first->origin));
      }
      node.items.push_back(convert(entry.second, line, depth + 1));
      node.keys.push_back(key);
    }
  }

  OriginOfLine origin_;
  std::size_t nodes_ = 0;
};

YamlNode parse(const std::string& text, const OriginOfLine& origin) {
  refuse_binary(text, origin);
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) {
      throw InputError(fmt::format("{}: a second YAML document begins, expected one only",
                                   origin(documents[1].Mark().line + 1)));
    }
    if (documents.empty() || documents[0].IsNull()) {
      return Converter(origin).convert(YAML::Node(), 1);
    }
    return Converter(origin).convert(documents[0], documents[0].Mark().line + 1);
  } catch (const YAML::Exception& error) {
    const int line = error.mark.is_null() ? 1 : error.mark.line + 1;
    if (is_indented_by_tab(text, line)) {
      throw InputError(origin(line) + ": the line is indented by a tab, expected spaces (YAML)");
    }
    throw InputError(fmt::format("{}: not valid YAML: {}", origin(line), error.msg));
  }
}

void assign_paths_below(YamlNode& node) {
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string& name = node.kind == YamlNode::Kind::map ? node.keys[i] : node.item_name(i);
    node.items[i].path = node.path.empty() ? name : node.path + "." + name;
    assign_paths_below(node.items[i]);
  }
}

}  // namespace

std::string YamlNode::where() const {
  return path.empty() || path_in_origin ? origin + ": " : origin + ": " + path + ": ";
}

const YamlNode* YamlNode::find(const std::string& key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

YamlNode* YamlNode::find(const std::string& key) {
  return const_cast<YamlNode*>(std::as_const(*this).find(key));
}

std::string YamlNode::item_name(std::size_t i) const {
  const YamlNode* name = items[i].find("name");
  return name != nullptr && name->kind == Kind::scalar ? name->text : std::to_string(i);
}

YamlNode read_yaml(const std::string& file) {
  const std::string text = read_text(file);
  return parse(text, [&](int line) { return fmt::format("{}:{}", file, line); });
}

YamlNode parse_yaml_value(const std::string& text, const std::string& origin) {
  return parse(text, [&](int) { return origin; });
}

void assign_paths(YamlNode& root) {
  assign_paths_below(root);
}

std::string quote(const std::string& text) {
  std::string out = "'";
  for (const char c : text.substr(0, max_quoted_bytes)) {
    out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  if (text.size() > max_quoted_bytes) out += "...";
  return out + "'";
}

}  // namespace knotlight
