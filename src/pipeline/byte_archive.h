// Plain data to bytes and back: one function that names the members of a structure serves both
// ways,
//
//   template <class Archive> void members(Archive& archive, Thing& thing) { archive(thing.a,
//   thing.b); }
//
// so that what is read cannot drift from what is written. Little-endian, IEEE numbers.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/errors.h"

namespace knotlight {

static_assert(std::endian::native == std::endian::little, "files are written as memory is");

class ByteWriter {
 public:
  template <typename... T>
  void operator()(T&... items) {
    (item(items), ...);
  }
  std::string& bytes() { return bytes_; }

 private:
  template <typename T>
  void item(T& x) {
    if constexpr (std::is_arithmetic_v<T>)
      raw(&x, sizeof(x));
    else
      members(*this, x);
  }
  void item(std::string& text) {
    size(text.size());
    raw(text.data(), text.size());
  }
  void item(Eigen::VectorXd& values) {
    size(static_cast<std::size_t>(values.size()));
    raw(values.data(), static_cast<std::size_t>(values.size()) * sizeof(double));
  }
  template <typename T>
  void item(std::vector<T>& list) {
    size(list.size());
    for (T& x : list) item(x);
  }
  template <typename A, typename B>
  void item(std::pair<A, B>& both) {
    item(both.first);
    item(both.second);
  }
  void size(std::uint64_t count) { raw(&count, sizeof(count)); }
  void raw(const void* data, std::size_t count) {
    bytes_.append(static_cast<const char*>(data), count);
  }

  std::string bytes_;
};

// Throws InputError("is cut short") when the bytes end too early, and never asks for more memory
// than there are bytes.
class ByteReader {
 public:
  ByteReader(const char* begin, const char* end) : at_(begin), end_(end) {}

  template <typename... T>
  void operator()(T&... items) {
    (item(items), ...);
  }
  bool at_end() const { return at_ == end_; }

 private:
  template <typename T>
  void item(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      unsigned char byte = 0;
      raw(&byte, 1);
      x = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      raw(&x, sizeof(x));
    } else {
      members(*this, x);
    }
  }
  void item(std::string& text) {
    text.resize(size(1));
    raw(text.data(), text.size());
  }
  void item(Eigen::VectorXd& values) {
    const std::size_t count = size(sizeof(double));
    values.resize(static_cast<Eigen::Index>(count));
    raw(values.data(), count * sizeof(double));
  }
  template <typename T>
  void item(std::vector<T>& list) {
    const std::size_t count = size(1);
    list.clear();
    for (std::size_t i = 0; i < count; ++i) item(list.emplace_back());
  }
  template <typename A, typename B>
  void item(std::pair<A, B>& both) {
    item(both.first);
    item(both.second);
  }
  // A count of things of at least `least` bytes each.
  std::size_t size(std::size_t least) {
    std::uint64_t count = 0;
    raw(&count, sizeof(count));
    if (count > static_cast<std::size_t>(end_ - at_) / least) throw InputError("is cut short");
    return count;
  }
  void raw(void* data, std::size_t count) {
    if (count > static_cast<std::size_t>(end_ - at_)) throw InputError("is cut short");
    if (count > 0) std::memcpy(data, at_, count);
    at_ += count;
  }

  const char* at_;
  const char* end_;
};

}  // namespace knotlight
