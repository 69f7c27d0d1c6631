// A fingerprint of bytes, for checksums of our own files and for telling whether two things are
// the same. Nobody attacks them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace knotlight {

// FNV-1a, 64 bits. Two inputs of one length that differ in one byte never have the same value: each
// step maps values one to one.
class Hash {
 public:
  void bytes(const void* data, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3ULL;
  }
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(T x) { bytes(&x, sizeof(x)); }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes(text.data(), text.size());
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace knotlight
