#include "scene/nearest_name.h"

#include <algorithm>

namespace knotlight {
namespace {

// More than a third of the letters wrong is another word, not a slip; short words get one slip.
std::size_t max_slips(const std::string& typed) {
  return std::max<std::size_t>(1, typed.size() / 3);
}

}  // namespace

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string did_you_mean(const std::string& typed, const std::vector<std::string>& valid) {
  const std::string* nearest = nullptr;
  std::size_t smallest = max_slips(typed) + 1;
  for (const std::string& name : valid) {
    // The table is quadratic: words of very different length need not be compared.
    const std::size_t difference =
        std::max(name.size(), typed.size()) - std::min(name.size(), typed.size());
    if (difference >= smallest) continue;
    const std::size_t distance = edit_distance(typed, name);
    if (distance < smallest) {
      smallest = distance;
      nearest = &name;
    }
  }
  return nearest == nullptr ? "" : " (did you mean '" + *nearest + "'?)";
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace knotlight
