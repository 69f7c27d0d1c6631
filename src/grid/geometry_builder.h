// Makes a GridGeometry from a shape, step by step.
#pragma once

#include <memory>
#include <vector>

#include "core/mesh.h"
#include "grid/geometry.h"

namespace knotlight {

class GeometryBuilder {
 public:
  GeometryBuilder(GridGeometry& geometry, const Workers& workers)
      : geometry_(geometry), workers_(workers) {}
  void build(const Shape& shape, double h);

 private:
  struct SurfaceCell {
    std::int32_t cell;
    Vec3 facing;         // sum of area |n|
    Vec3 outward;        // sum of area n
    double area;         // in faces of a cell
    std::int32_t found;  // its place in surface_moments_
  };
  // What the lines say about a surface cell.
  struct SampledCell {
    Places inside = 0;
    std::array<std::uint16_t, 6> links{};
    bool split = false;
    Moments volume{};                     // of all parts together, in cell volumes
    std::unique_ptr<CellSample> details;  // of cells without places or that a gap may divide
  };

  Level& level() { return geometry_.levels_.front(); }
  void find_surface_cells(const TriangleMesh& mesh);
  void find_whole_cells(const ScanLines& x_lines);
  void sample_surface_cells(const AxisLines& lines);
  bool joins_neighbour(std::size_t sample) const;
  void make_pieces();
  void add_split_volumes();
  void add_surface(const TriangleMesh& mesh);
  double thin_area() const;
  void connect_lone_pieces();
  void judge(double true_volume, double true_area);

  // The cut record of a piece; a whole cell gets one of its own.
  CutPiece& cut_of(std::int32_t piece);
  std::int32_t owner_of(std::int32_t cell, const CellSample& sample, int line,
                        const LinePart& part) const;

  GridGeometry& geometry_;
  const Workers& workers_;
  std::vector<SurfaceCell> surface_cells_;  // by cell
  std::vector<Moments> surface_moments_;    // one per surface cell, in cell faces
  std::vector<SampledCell> samples_;        // one per surface cell
  double area_found_ = 0.0;                 // in faces of a cell
};

}  // namespace knotlight
