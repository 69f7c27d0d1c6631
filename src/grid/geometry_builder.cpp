#include "grid/geometry_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "grid/shape_mesh.h"
#include "grid/surface_pieces.h"

namespace knotlight {
namespace {

constexpr double most_cells = 1 << 30;                          // 32-bit numbers of nodes
constexpr std::int32_t outside = -1, whole = -2, surface = -3;  // cells before pieces are numbered
constexpr std::size_t cells_per_chunk = 1024;
// A cell with less of the object is left out, and its surface goes with the cell beside it: below
// this, volumes are rounding.
constexpr double least_volume = 1e-9;
// Coarsening ends here: a dense factorisation of this size costs less than a millisecond.
constexpr std::int32_t coarsest_unknowns = 200;

constexpr std::uint8_t all_faces = 0x3f;
// Of the area of a sheet's two sides, what may be left of the sum of area n along its main axis. A
// corner keeps 0.57 or more.
constexpr double one_sided = 0.4;

// What calls a shape unresolved. Shares of the whole that would show as errors of a per cent.
constexpr double volume_allowed = 0.01;
constexpr double area_allowed = 0.01;
constexpr double thin_allowed = 0.05;
constexpr double unsure_allowed = 1e-3;  // of the lines

}  // namespace

void GeometryBuilder::build(const Shape& shape, double h) {
  const double true_volume = volume(shape), true_area = surface_area(shape);
  const Bounds box = bounds(shape);
  const Vec3 cells = (box.hi - box.lo) / h + Vec3::Constant(4.0);
  geometry_.levels_.resize(1);
  level().grid.h = h;
  if (!(h > 0.0) || !(true_volume > 0.0) || !std::isfinite(true_volume)) {
    geometry_.failure_ = "the shape has no volume, or its cells no size";
    return;
  }
  if (!(cells.prod() < most_cells)) {
    geometry_.failure_ = fmt::format("{:.3g} cells are too many", cells.prod());
    return;
  }
  level().grid = grid_around(shape, h);
  const TriangleMesh mesh = mesh_in_cells(shape, level().grid);
  level().first_piece.assign(level().grid.cells(), outside);
  find_surface_cells(mesh);
  {
    std::array<std::unique_ptr<ScanLines>, 3> made;
    workers_.for_chunks(3, 1, [&](std::size_t axis, std::size_t, std::size_t) {
      made[axis] = std::make_unique<ScanLines>(mesh, level().grid.n, static_cast<int>(axis));
    });
    const AxisLines lines{std::move(*made[0]), std::move(*made[1]), std::move(*made[2])};
    for (const ScanLines& l : lines) geometry_.quality_.unsure_lines += l.unsure_lines();
    find_whole_cells(lines[0]);
    sample_surface_cells(lines);
  }
  make_pieces();
  if (level().pieces.empty()) {
    geometry_.failure_ = "no cell holds any of the object: it is far thinner than a cell";
    return;
  }
  add_split_volumes();
  add_surface(mesh);
  connect_lone_pieces();
  number_unknowns(level());
  judge(true_volume, true_area);
  while (geometry_.levels_.back().dofs > coarsest_unknowns)
    geometry_.levels_.push_back(coarser(geometry_.levels_.back()));
}

namespace {

// To the moments of a cell, which need not be the piece's own.
void add_surface_piece(Moments& moments, const SurfacePiece& piece,
                       const std::array<int, 3>& cell) {
  for (const SurfaceNode& node : quadrature(piece))
    add_point(moments, node.position - Vec3(cell[0], cell[1], cell[2]), node.weight);
}

// Whether the box of a triangle meets one of the marked cells; a little more than its own cells,
// for pieces in a grid plane.
bool meets(const TriangleMesh& mesh, std::size_t triangle, const CellGrid& grid,
           const std::vector<bool>& marked) {
  Vec3 lo = mesh.corner(triangle, 0), hi = lo;
  for (int v = 1; v < 3; ++v) {
    lo = lo.cwiseMin(mesh.corner(triangle, v));
    hi = hi.cwiseMax(mesh.corner(triangle, v));
  }
  std::array<int, 3> first, last;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    first[a] = std::max(0, static_cast<int>(std::ceil(lo[axis])) - 1);
    last[a] = std::min(grid.n[a] - 1, static_cast<int>(std::floor(hi[axis])));
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i)
        if (marked[static_cast<std::size_t>(grid.index(i, j, k))]) return true;
  return false;
}

}  // namespace

void GeometryBuilder::find_surface_cells(const TriangleMesh& mesh) {
  std::vector<std::int32_t>& state = level().first_piece;
  for_each_surface_piece(mesh, [&](const SurfacePiece& piece) {
    const auto cell =
        static_cast<std::size_t>(level().grid.index(piece.cell[0], piece.cell[1], piece.cell[2]));
    if (state[cell] == outside) {
      state[cell] = surface - static_cast<std::int32_t>(surface_cells_.size());
      surface_cells_.push_back({static_cast<std::int32_t>(cell), Vec3::Zero(), Vec3::Zero(), 0.0,
                                static_cast<std::int32_t>(surface_moments_.size())});
      surface_moments_.emplace_back();
    }
    SurfaceCell& found = surface_cells_[static_cast<std::size_t>(surface - state[cell])];
    found.facing += piece.area * piece.normal.cwiseAbs();
    found.outward += piece.area * piece.normal;
    found.area += piece.area;
    add_surface_piece(surface_moments_[static_cast<std::size_t>(found.found)], piece, piece.cell);
  });
  std::sort(surface_cells_.begin(), surface_cells_.end(),
            [](const SurfaceCell& a, const SurfaceCell& b) { return a.cell < b.cell; });
  for (std::size_t s = 0; s < surface_cells_.size(); ++s)
    state[static_cast<std::size_t>(surface_cells_[s].cell)] =
        surface - static_cast<std::int32_t>(s);
}

// A cell without surface is inside or outside as its centre is; a line beside the centre tells.
void GeometryBuilder::find_whole_cells(const ScanLines& x_lines) {
  const auto& n = level().grid.n;
  constexpr int middle = lines_per_cell / 2;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (const Interval& part :
           x_lines.line(lines_per_cell * j + middle, lines_per_cell * k + middle)) {
        const int first = std::max(0, static_cast<int>(std::ceil(part.begin - 0.5)));
        const int last = std::min(n[0] - 1, static_cast<int>(std::floor(part.end - 0.5)));
        for (int i = first; i <= last; ++i) {
          std::int32_t& state =
              level().first_piece[static_cast<std::size_t>(level().grid.index(i, j, k))];
          if (state == outside) state = whole;
        }
      }
}

void GeometryBuilder::sample_surface_cells(const AxisLines& lines) {
  samples_.resize(surface_cells_.size());
  workers_.for_chunks(
      samples_.size(), cells_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        CellSample sample;  // its memory serves all cells
        for (std::size_t s = begin; s < end; ++s) {
          sample_cell(lines, level().grid.position(surface_cells_[s].cell),
                      surface_cells_[s].facing, sample);
          SampledCell& kept = samples_[s];
          kept.inside = sample.inside;
          kept.links = sample.links;
          kept.split = sample.split();
          for (int line = 0; line < 16; ++line)
            for (const LinePart& part : sample.lines[static_cast<std::size_t>(line)])
              add_line_part(kept.volume, sample.axis, line, part, Vec3::Zero());
          if (kept.split || sample.parts.empty())
            kept.details = std::make_unique<CellSample>(sample);
        }
      });
}

// Whether what a cell too thin to have places holds goes on in the next cell: some line does.
bool GeometryBuilder::joins_neighbour(std::size_t index) const {
  const Level& fine = geometry_.finest();
  const CellSample& sample = *samples_[index].details;
  for (int line = 0; line < 16; ++line)
    for (const LinePart& part : sample.lines[static_cast<std::size_t>(line)])
      for (const int side : {-1, 1}) {
        if (side < 0 ? part.begin > 0.0 : part.end < 1.0) continue;
        auto beside = fine.grid.position(surface_cells_[index].cell);
        beside[static_cast<std::size_t>(sample.axis)] += side;
        const std::int32_t state = fine.first_piece[static_cast<std::size_t>(
            fine.grid.index(beside[0], beside[1], beside[2]))];
        const int bit = place_bit(sample.axis, side < 0 ? lines_per_cell - 1 : 0, line);
        if (state == whole) return true;
        if (state <= surface &&
            (samples_[static_cast<std::size_t>(surface - state)].inside >> bit & 1) != 0)
          return true;
      }
  return false;
}

// Pieces in the order of their cells; volumes of cells that no gap divides.
void GeometryBuilder::make_pieces() {
  std::vector<std::int32_t>& state = level().first_piece;
  std::vector<bool> joins(samples_.size());
  for (std::size_t s = 0; s < samples_.size(); ++s)
    joins[s] = samples_[s].inside == 0 && joins_neighbour(s);
  std::size_t next_sample = 0;
  for (std::size_t cell = 0; cell < state.size(); ++cell) {
    if (state[cell] == outside) continue;
    const auto first = static_cast<std::int32_t>(level().pieces.size());
    if (state[cell] == whole) {
      level().pieces.push_back({static_cast<std::int32_t>(cell), -1, {}});
      state[cell] = first;
      continue;
    }
    const bool joined = joins[next_sample];
    SampledCell& sample = samples_[next_sample++];
    if (joined || !(total(sample.volume) > least_volume)) {
      state[cell] = outside;
      if (joined)
        geometry_.splits_.emplace_back(static_cast<std::int32_t>(cell), std::move(*sample.details));
      continue;
    }
    const auto add_piece = [&](Places places) {
      CutPiece cut;
      cut.piece = static_cast<std::int32_t>(level().pieces.size());
      cut.inside = places;
      cut.links = sample.links;
      if (!sample.split) cut.volume = sample.volume;
      level().pieces.push_back(
          {static_cast<std::int32_t>(cell), static_cast<std::int32_t>(level().cuts.size()), {}});
      level().cuts.push_back(cut);
    };
    if (sample.split && sample.inside != 0)
      for (const Places places : sample.details->parts) add_piece(places);
    else
      add_piece(sample.inside);
    state[cell] = first;
    if (sample.split)
      geometry_.splits_.emplace_back(static_cast<std::int32_t>(cell), std::move(*sample.details));
  }
  samples_.clear();
}

// The piece that a part of a line belongs to: the one that has a place on it. A part too thin for
// that continues in the next cell. -1 if neither is seen.
std::int32_t GeometryBuilder::owner_of(std::int32_t cell, const CellSample& sample, int line,
                                       const LinePart& part) const {
  const Level& fine = geometry_.finest();
  const auto p = fine.grid.position(cell);
  const auto holder = [&](const std::array<int, 3>& at, int layer) {
    const auto [first, last] = fine.pieces_of(at[0], at[1], at[2]);
    for (std::int32_t piece = first; piece < last; ++piece) {
      const Places inside = fine.whole(piece) ? all_places : fine.cut(piece).inside;
      if ((inside >> place_bit(sample.axis, layer, line) & 1) != 0) return piece;
    }
    return std::int32_t{-1};
  };
  for (int layer = 0; layer < lines_per_cell; ++layer) {
    const double at = (layer + 0.5) / lines_per_cell;
    if (at < part.begin || at > part.end) continue;
    if (const std::int32_t piece = holder(p, layer); piece >= 0) return piece;
  }
  for (const int side : {-1, 1}) {
    if (side < 0 ? part.begin > 0.0 : part.end < 1.0) continue;
    auto beside = p;
    beside[static_cast<std::size_t>(sample.axis)] += side;
    if (const std::int32_t piece = holder(beside, side < 0 ? lines_per_cell - 1 : 0); piece >= 0)
      return piece;
  }
  return -1;
}

CutPiece& GeometryBuilder::cut_of(std::int32_t piece) {
  Piece& p = level().pieces[static_cast<std::size_t>(piece)];
  if (p.cut < 0) {
    p.cut = static_cast<std::int32_t>(level().cuts.size());
    CutPiece cut;
    cut.piece = piece;
    cut.volume = full_cell_moments();
    cut.inside = all_places;
    cut.links.fill(0xffff);
    level().cuts.push_back(cut);
  }
  return level().cuts[static_cast<std::size_t>(p.cut)];
}

void GeometryBuilder::add_split_volumes() {
  for (auto& [cell, sample] : geometry_.splits_) {
    std::int32_t usual = level().first_piece[static_cast<std::size_t>(cell)];
    for (int line = 0; line < 16; ++line)
      for (LinePart& part : sample.lines[static_cast<std::size_t>(line)]) {
        part.piece = owner_of(cell, sample, line, part);
        if (usual < 0) usual = part.piece;
      }
    for (auto& line : sample.lines)
      for (LinePart& part : line)
        if (part.piece < 0) part.piece = usual;
  }
  for (const auto& [cell, sample] : geometry_.splits_)
    for (int line = 0; line < 16; ++line)
      for (const LinePart& part : sample.lines[static_cast<std::size_t>(line)]) {
        const auto home = level().grid.position(cell);
        const auto owner =
            level().grid.position(level().pieces[static_cast<std::size_t>(part.piece)].cell);
        const Vec3 shift(owner[0] - home[0], owner[1] - home[1], owner[2] - home[2]);
        add_line_part(cut_of(part.piece).volume, sample.axis, line, part, shift);
      }
}

void GeometryBuilder::add_surface(const TriangleMesh& mesh) {
  const Level& fine = level();
  // Cells in one piece have theirs already; of the others each bit of surface looks for its own.
  std::vector<bool> open(fine.grid.cells());
  bool any_open = false;
  const auto& splits = geometry_.splits_;
  auto split = splits.begin();
  for (const SurfaceCell& s : surface_cells_) {
    while (split != splits.end() && split->first < s.cell) ++split;
    const std::int32_t piece = fine.first_piece[static_cast<std::size_t>(s.cell)];
    if (piece < 0 || (split != splits.end() && split->first == s.cell)) {
      open[static_cast<std::size_t>(s.cell)] = true;
      any_open = true;
      continue;
    }
    area_found_ += s.area;
    cut_of(piece).surface = surface_moments_[static_cast<std::size_t>(s.found)];
  }
  surface_moments_.clear();
  if (!any_open) return;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (meets(mesh, t, fine.grid, open))
      for_each_surface_piece(mesh, t, [&](const SurfacePiece& piece) {
        if (!open[static_cast<std::size_t>(
                fine.grid.index(piece.cell[0], piece.cell[1], piece.cell[2]))])
          return;
        const Vec3 centroid = (piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3.0;
        const Place place = geometry_.locate_in_cells(
            Vec3(piece.cell[0] + 0.5, piece.cell[1] + 0.5, piece.cell[2] + 0.5),
            centroid - step_inside * piece.normal);
        if (place.piece < 0) return;
        area_found_ += piece.area;
        add_surface_piece(
            cut_of(place.piece).surface, piece,
            fine.grid.position(fine.pieces[static_cast<std::size_t>(place.piece)].cell));
      });
}

// Surface with no whole cell among the 27 around it.
double GeometryBuilder::thin_area() const {
  const Level& fine = geometry_.finest();
  std::vector<bool> filled(fine.pieces.size());
  for (std::size_t p = 0; p < filled.size(); ++p) {
    const std::int32_t cut = fine.pieces[p].cut;
    filled[p] =
        cut < 0 || total(fine.cuts[static_cast<std::size_t>(cut)].volume) > 1.0 - least_volume;
  }
  double area = 0.0;
  for (const SurfaceCell& s : surface_cells_) {
    const auto c = fine.grid.position(s.cell);
    bool thin = true;
    for (int k = c[2] - 1; k <= c[2] + 1; ++k)
      for (int j = c[1] - 1; j <= c[1] + 1; ++j)
        for (int i = c[0] - 1; i <= c[0] + 1; ++i) {
          const auto [first, last] = fine.pieces_of(i, j, k);
          thin = thin && (last == first || !filled[static_cast<std::size_t>(first)]);
        }
    if (thin) area += s.area;
  }
  return area;
}

// A piece that no line links to anything is a corner of the object whose foot lies between the
// lines: taken as connected to the cell that its surface faces away from. Or it is part of a sheet
// too thin to have places, with surface on both sides: taken as connected all around.
void GeometryBuilder::connect_lone_pieces() {
  Level& fine = level();
  const auto linked = [&](std::int32_t piece) {
    const auto p = fine.grid.position(fine.pieces[static_cast<std::size_t>(piece)].cell);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        auto q = p;
        q[static_cast<std::size_t>(axis)] += side;
        const auto [first, last] = fine.pieces_of(q[0], q[1], q[2]);
        for (std::int32_t other = first; other < last; ++other)
          if (side < 0 ? connected(fine, other, piece, axis) : connected(fine, piece, other, axis))
            return true;
      }
    return false;
  };
  for (const SurfaceCell& s : surface_cells_) {
    const auto p = fine.grid.position(s.cell);
    const auto [first, last] = fine.pieces_of(p[0], p[1], p[2]);
    for (std::int32_t piece = first; piece < last; ++piece) {
      if (fine.whole(piece) || linked(piece)) continue;
      Eigen::Index axis = 0;
      const double most = s.outward.cwiseAbs().maxCoeff(&axis);
      cut_of(piece).loose =
          most > one_sided * s.area
              ? static_cast<std::uint8_t>(1 << (2 * axis + (s.outward[axis] < 0.0 ? 1 : 0)))
              : all_faces;
    }
  }
}

void GeometryBuilder::judge(double true_volume, double true_area) {
  GridQuality& q = geometry_.quality_;
  const double h = level().grid.h;
  const std::size_t whole_cells = level().pieces.size() - level().cuts.size();
  double sum = static_cast<double>(whole_cells);
  for (const CutPiece& cut : level().cuts) sum += total(cut.volume);
  q.cells = level().pieces.size();
  q.cut_cells = level().cuts.size();
  q.volume_error = std::abs(sum * h * h * h / true_volume - 1.0);
  q.area_error = std::abs(area_found_ * h * h / true_area - 1.0);
  q.thin_share = thin_area() * h * h / true_area;
  q.mean_chord_in_cells = 4.0 * true_volume / (true_area * h);
  const auto& n = level().grid.n;
  const double lines = static_cast<double>(lines_per_cell * lines_per_cell) *
                       (1.0 * n[0] * n[1] + 1.0 * n[1] * n[2] + 1.0 * n[2] * n[0]);
  if (q.thin_share > thin_allowed)
    geometry_.unresolved_ =
        fmt::format("{:.0f} % of the surface is on parts thinner than two or three cells",
                    100.0 * q.thin_share);
  else if (q.volume_error > volume_allowed)
    geometry_.unresolved_ = fmt::format("the cells miss {:.2g} of the volume", q.volume_error);
  else if (q.area_error > area_allowed)
    geometry_.unresolved_ = fmt::format("the cells miss {:.2g} of the surface", q.area_error);
  else if (static_cast<double>(q.unsure_lines) > unsure_allowed * lines)
    geometry_.unresolved_ =
        fmt::format("{} of {:.0f} scan lines do not leave the mesh as often as they enter it",
                    q.unsure_lines, lines);
}

}  // namespace knotlight
