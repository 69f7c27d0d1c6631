#include "grid/cell_sampling.h"

#include <algorithm>
#include <cmath>

namespace knotlight {
namespace {

constexpr std::array<int, 3> stride{1, 4, 16};

// Where place `layer` (-1 .. 4: also the neighbours' nearest) lies along an edge of the cell.
double place(int layer) {
  return (layer + 0.5) / lines_per_cell;
}

Places connected_places(Places seed, const std::array<Places, 3>& link_up) {
  Places part = seed, before = 0;
  while (part != before) {
    before = part;
    for (std::size_t a = 0; a < 3; ++a) {
      part |= (part & link_up[a]) << stride[a];
      part |= (part >> stride[a]) & link_up[a];
    }
  }
  return part;
}

}  // namespace

int place_bit(int axis, int layer, int line) {
  return layer * stride[static_cast<std::size_t>(axis)] +
         (line & 3) * stride[static_cast<std::size_t>((axis + 1) % 3)] +
         (line >> 2) * stride[static_cast<std::size_t>((axis + 2) % 3)];
}

bool CellSample::split() const {
  return parts.size() > 1 ||
         std::any_of(lines.begin(), lines.end(), [](const auto& line) { return line.size() > 1; });
}

void sample_cell(const AxisLines& all_lines, const std::array<int, 3>& cell, const Vec3& facing,
                 CellSample& sample) {
  sample.inside = 0;
  sample.links = {};
  sample.parts.clear();
  for (auto& line : sample.lines) line.clear();
  Eigen::Index chosen = 0;
  facing.maxCoeff(&chosen);
  sample.axis = static_cast<int>(chosen);
  std::array<Places, 3> link_up{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
    for (int line = 0; line < 16; ++line) {
      const auto intervals = all_lines[a].line(lines_per_cell * cell[b] + (line & 3),
                                               lines_per_cell * cell[c] + (line >> 2));
      const double start = cell[a];
      auto part = std::partition_point(intervals.begin(), intervals.end(), [&](const Interval& i) {
        return i.end <= start + place(-1);
      });
      for (; part != intervals.end() && part->begin < start + place(lines_per_cell); ++part) {
        const double begin = part->begin - start, end = part->end - start;
        const auto holds = [&](int layer) { return begin <= place(layer) && place(layer) <= end; };
        for (int s = 0; s < lines_per_cell; ++s) {
          if (!holds(s)) continue;
          const Places bit = Places{1} << place_bit(axis, s, line);
          if (axis == 0) sample.inside |= bit;
          if (s + 1 < lines_per_cell && holds(s + 1)) link_up[a] |= bit;
        }
        if (holds(-1) && holds(0)) sample.links[2 * a] |= static_cast<std::uint16_t>(1U << line);
        if (holds(lines_per_cell - 1) && holds(lines_per_cell))
          sample.links[2 * a + 1] |= static_cast<std::uint16_t>(1U << line);
        if (axis == sample.axis && std::min(end, 1.0) > std::max(begin, 0.0))
          sample.lines[static_cast<std::size_t>(line)].push_back(
              {std::max(begin, 0.0), std::min(end, 1.0), -1});
      }
    }
  }
  // The three axes' lines may disagree about a place that lies on the surface to rounding.
  for (std::size_t a = 0; a < 3; ++a) link_up[a] &= sample.inside & (sample.inside >> stride[a]);
  for (Places rest = sample.inside; rest != 0;) {
    sample.parts.push_back(connected_places(rest & (~rest + 1), link_up));
    rest &= ~sample.parts.back();
  }
}

void add_line_part(Moments& moments, int axis, int line, const LinePart& part, const Vec3& shift) {
  // Four equidistant lines with these weights are exact for cubics, as two Gauss points are along
  // the line.
  constexpr double outer = 13.0 / 48.0, inner = 11.0 / 48.0;
  const auto weight = [](int s) { return s == 0 || s == 3 ? outer : inner; };
  const double half = 0.5 * (part.end - part.begin), middle = 0.5 * (part.end + part.begin);
  const double across = weight(line & 3) * weight(line >> 2);
  for (const double sign : {-1.0, 1.0}) {
    Vec3 x;
    x[axis] = middle + sign * half / std::sqrt(3.0);
    x[(axis + 1) % 3] = place(line & 3);
    x[(axis + 2) % 3] = place(line >> 2);
    add_point(moments, x - shift, across * half);
  }
}

}  // namespace knotlight
