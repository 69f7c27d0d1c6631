// Meshes and files for tests: solids with known measures, and broken versions of them.
#pragma once

#include <filesystem>
#include <string>

#include "core/mesh.h"

namespace knotlight::test {

// Icosahedron with each triangle cut into 4 `levels` times, all vertices on the sphere: 20 *
// 4^levels triangles, outward, closed.
TriangleMesh icosphere(int levels, const Vec3& center = Vec3::Zero(), double radius = 1.0);

// Torus around the z axis with 2 * around * across triangles, outward, closed.
TriangleMesh torus_mesh(double major_radius, double minor_radius, int around, int across);

// Strip of 2 * around triangles around the z axis, turned by half_turns half turns: 1 gives a
// Moebius strip.
TriangleMesh twisted_strip(int around, int half_turns);

// Two meshes as one, without touching them.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b);
TriangleMesh moved(TriangleMesh mesh, const Vec3& by);
TriangleMesh turned_inside_out(TriangleMesh mesh);
// Every triangle with three vertices of its own.
TriangleMesh triangle_soup(const TriangleMesh& mesh);
TriangleMesh without_triangle(TriangleMesh mesh, std::size_t triangle);

// Number of edges that do not belong to exactly two triangles running through them in opposite
// directions: 0 for a closed, consistently oriented mesh.
std::size_t open_edges(const TriangleMesh& mesh);
double length_of_open_edges(const TriangleMesh& mesh);
double longest_edge(const TriangleMesh& mesh);

// A file in the system's folder for temporary files, removed with the object.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& extension, const std::string& content);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// The mesh as the text of a file.
std::string as_obj(const TriangleMesh& mesh);
std::string as_text_stl(const TriangleMesh& mesh);
std::string as_binary_stl(const TriangleMesh& mesh);
std::string as_text_ply(const TriangleMesh& mesh);

}  // namespace knotlight::test
