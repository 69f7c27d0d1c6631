// The steps of make_solid, one source file each. All of them work on vertex indices: who touches
// whom is decided once, by merge_vertices, and never again by comparing coordinates.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh.h"

namespace knotlight {

// Distances below this part of the mesh's size mean nothing: mesh files and their readers hold
// single precision, which resolves 6e-8.
constexpr double same_position_fraction = 1e-7;

// Half-edge 3 t + i runs from corner i of triangle t to corner i + 1.
using HalfEdge = std::uint32_t;
constexpr HalfEdge no_twin = 0xffffffffU;

inline HalfEdge next_in_triangle(HalfEdge h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
inline std::uint32_t start_vertex(const TriangleMesh& mesh, HalfEdge h) {
  return mesh.triangles[h / 3][h % 3];
}
inline std::uint32_t end_vertex(const TriangleMesh& mesh, HalfEdge h) {
  return start_vertex(mesh, next_in_triangle(h));
}
// The same for both directions of an edge.
std::uint64_t edge_key(std::uint32_t a, std::uint32_t b);

// For each half-edge the one of the neighbouring triangle along the same edge, whatever its
// direction; no_twin on a border. Throws InputError if an edge belongs to more than two triangles.
std::vector<HalfEdge> find_twins(const TriangleMesh& mesh);

// Parts of the surface that hang together by edges: for each triangle the number of its part, parts
// numbered by their first triangle.
struct Parts {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> of_triangle;
};
Parts find_parts(const TriangleMesh& mesh, const std::vector<HalfEdge>& twins);

// Turns triangles until neighbours agree on which side is outside; of the two ways for each part
// the one with fewer turns. Returns how many were turned. Throws InputError for a one-sided
// surface.
std::size_t orient_consistently(TriangleMesh& mesh);

// Closes the holes of a consistently oriented mesh that make_solid may close, and returns their
// number; throws InputError for the others.
std::size_t fill_holes(TriangleMesh& mesh);

// Takes triangles flatter than `tolerance` (length) out of a closed mesh by turning the edge they
// share with the neighbour along their longest side; the mesh stays closed. Returns how many.
std::size_t remove_flat_triangles(TriangleMesh& mesh, double tolerance);

// For a closed, consistently oriented mesh: turns parts so that the material is inside. A part
// within another's material is a cavity if it faces the other way; otherwise it adds nothing and is
// left out. Appends warnings; throws InputError for a part without volume.
void orient_outward(TriangleMesh& mesh, double tolerance, std::vector<std::string>& warnings);

// Drops vertices that no triangle uses.
void drop_unused_vertices(TriangleMesh& mesh);

// "(x, y, z)" for messages.
std::string coordinates(const Vec3& p);
Vec3 centroid(const TriangleMesh& mesh, std::size_t triangle);

}  // namespace knotlight
