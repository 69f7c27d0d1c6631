// Factored systems that outlive a solve. What is expensive about a method does not know the light:
// channels that share lambda and k share it, and new lights cost their photons and a
// back-substitution.
#pragma once

#include <any>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "scene/scene.h"

namespace knotlight {

// Belongs to one set of objects and materials and one tolerance: with others make a new one. Safe
// to use from several threads at once.
class FactorCache {
 public:
  struct Key {
    std::uint32_t object;  // index in the scene
    Method method;
    double lambda;  // 1/length
    double k;       // length
    // clang-tidy 14 takes the 0 that <=> is compared with for a pointer.
    auto operator<=>(const Key&) const = default;  // NOLINT(modernize-use-nullptr)
  };

  // What was put there last; null if nothing was.
  template <class Factors>
  std::shared_ptr<const Factors> find(const Key& key) const {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(key);
    if (entry == entries_.end()) return nullptr;
    return std::any_cast<std::shared_ptr<const Factors>>(entry->second);
  }
  template <class Factors>
  void put(const Key& key, std::shared_ptr<const Factors> factors) {
    const std::lock_guard lock(mutex_);
    entries_[key] = std::move(factors);
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return entries_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::map<Key, std::any> entries_;
};

}  // namespace knotlight
