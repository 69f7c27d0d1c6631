#include "grid/scan_lines.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

struct Crossing {
  double t;
  int winding;  // +1 entering, -1 leaving
};

// One triangle seen along the axis: which lines it covers, and where they cross it.
class Footprint {
 public:
  Footprint(const TriangleMesh& mesh, const Triangle& triangle, int axis) : triangle_(triangle) {
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3& p = mesh.vertices[triangle[v]];
      t_[v] = p[axis];
      p_[v] = {p[(axis + 1) % 3], p[(axis + 2) % 3]};
    }
  }

  // Calls visit(i, j, crossing) for each line covered.
  template <class Visit>
  void for_each_line(int columns, int rows, const Visit& visit) const {
    const auto [i0, i1] = line_range(0, columns);
    const auto [j0, j1] = line_range(1, rows);
    for (int j = j0; j < j1; ++j)
      for (int i = i0; i < i1; ++i) {
        const Eigen::Vector2d q((i + 0.5) / lines_per_cell, (j + 0.5) / lines_per_cell);
        std::array<double, 3> edge;  // of edge v: from corner v to the next
        int positive = 0;
        for (std::size_t v = 0; v < 3; ++v) positive += edge_value(v, q, edge[v]) ? 1 : 0;
        if (positive != 0 && positive != 3) continue;
        visit(i, j, Crossing{depth(edge), positive == 3 ? -1 : 1});
      }
  }

 private:
  std::pair<int, int> line_range(int coordinate, int count) const {
    const auto [lo, hi] = std::minmax({p_[0][coordinate], p_[1][coordinate], p_[2][coordinate]});
    return {std::max(0, static_cast<int>(std::floor(lo * lines_per_cell - 0.5))),
            std::min(count, static_cast<int>(std::floor(hi * lines_per_cell - 0.5)) + 2)};
  }

  // Twice the signed area of (edge, q); returns its sign. The two triangles of an edge must agree
  // on the side of q to the last bit, or a line could slip between them: the value is always taken
  // from the corner of lower number to that of higher number.
  bool edge_value(std::size_t v, const Eigen::Vector2d& q, double& value) const {
    std::size_t from = v, to = (v + 1) % 3;
    const bool swapped = triangle_[from] > triangle_[to];
    if (swapped) std::swap(from, to);
    const Eigen::Vector2d e = p_[to] - p_[from], d = q - p_[from];
    const double area = e.x() * d.y() - e.y() * d.x();
    value = swapped ? -area : area;
    // A line through an edge is taken as shifted by (epsilon, epsilon^2).
    const bool left = area != 0.0 ? area > 0.0 : e.y() < 0.0 || (e.y() == 0.0 && e.x() > 0.0);
    return left != swapped;
  }

  // The weight of a corner is the area of the edge that faces it. Clamped: for a triangle seen
  // edge-on the weights are rounding.
  double depth(const std::array<double, 3>& edge) const {
    const double area = edge[0] + edge[1] + edge[2];
    const auto [lo, hi] = std::minmax({t_[0], t_[1], t_[2]});
    if (area == 0.0) return 0.5 * (lo + hi);
    const double t = (edge[1] * t_[0] + edge[2] * t_[1] + edge[0] * t_[2]) / area;
    return std::clamp(t, lo, hi);
  }

  Triangle triangle_;
  std::array<Eigen::Vector2d, 3> p_;
  std::array<double, 3> t_;
};

}  // namespace

ScanLines::ScanLines(const TriangleMesh& mesh, const std::array<int, 3>& n, int axis)
    : axis_(axis), columns_(lines_per_cell * n[static_cast<std::size_t>((axis + 1) % 3)]) {
  const int rows = lines_per_cell * n[static_cast<std::size_t>((axis + 2) % 3)];
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows);
  const auto at = [this](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(i);
  };
  // Crossings bucketed by line: count, then fill.
  std::vector<std::size_t> start(count + 1, 0);
  for (const Triangle& t : mesh.triangles)
    Footprint(mesh, t, axis).for_each_line(columns_, rows, [&](int i, int j, const Crossing&) {
      ++start[at(i, j) + 1];
    });
  for (std::size_t l = 0; l < count; ++l) start[l + 1] += start[l];
  std::vector<Crossing> crossings(start[count]);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (const Triangle& t : mesh.triangles)
    Footprint(mesh, t, axis).for_each_line(columns_, rows, [&](int i, int j, const Crossing& c) {
      crossings[next[at(i, j)]++] = c;
    });

  first_.reserve(count + 1);
  first_.push_back(0);
  intervals_.reserve(crossings.size() / 2);
  for (std::size_t l = 0; l < count; ++l) {
    const auto begin = crossings.begin() + static_cast<std::ptrdiff_t>(start[l]);
    const auto end = crossings.begin() + static_cast<std::ptrdiff_t>(start[l + 1]);
    int sum = 0;
    for (auto c = begin; c != end; ++c) sum += c->winding;
    if (sum != 0) {
      ++unsure_;
      if (l > 0) {
        const std::vector<Interval> before(
            intervals_.begin() + static_cast<std::ptrdiff_t>(first_[l - 1]), intervals_.end());
        intervals_.insert(intervals_.end(), before.begin(), before.end());
      }
    } else {
      std::sort(begin, end, [](const Crossing& x, const Crossing& y) { return x.t < y.t; });
      int winding = 0;
      double entered = 0.0;
      for (auto c = begin; c != end; ++c) {
        if (winding <= 0 && winding + c->winding > 0) entered = c->t;
        if (winding > 0 && winding + c->winding <= 0 && c->t > entered)
          intervals_.push_back({entered, c->t});
        winding += c->winding;
      }
    }
    first_.push_back(intervals_.size());
  }
}

}  // namespace knotlight
