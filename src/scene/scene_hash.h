// Fingerprints of what a scene is made of, for files that belong to one scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "core/hash.h"
#include "scene/scene.h"

namespace knotlight {

class SceneHash {
 public:
  template <typename... T>
  static std::uint64_t of(const T&... items) {
    SceneHash hash;
    (hash.add(items), ...);
    return hash.value();
  }

  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>
  void add(const T& x) { hash_(x); }
  void add(const Vec3& v);
  void add(const Spectrum& s);
  template <typename T>
  void add(const std::optional<T>& x) {
    add(x.has_value());
    if (x) add(*x);
  }
  template <typename... T>
  void add(const std::variant<T...>& x) {
    add(x.index());
    std::visit([this](const auto& one) { add(one); }, x);
  }
  void add(const PointLight& light);
  void add(const DirectionalLight& light);
  void add(const AreaLight& light);
  void add(const EnvironmentLight& light);
  void add(const Sphere& sphere);
  void add(const TriangleMesh& mesh);
  void add(const TranslucentMaterial& material);
  void add(const DiffuseMaterial& material);

  std::uint64_t value() const { return hash_.value(); }

 private:
  Hash hash_;
};

}  // namespace knotlight
