#include "core/ply_writer.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "core/file_io.h"

namespace knotlight {

void write_ply(const std::string& path, const TriangleMesh& mesh, const std::string& comment) {
  write_atomically(path, [&](const std::string& pending) {
    std::ofstream file(pending, std::ios::binary);
    file << fmt::format(
        "ply\nformat binary_little_endian 1.0\n{}"
        "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        comment.empty() ? "" : "comment " + comment + "\n", mesh.vertices.size(),
        mesh.triangles.size());
    const auto put = [&file](const auto& value) {
      file.write(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    for (const Vec3& v : mesh.vertices)
      for (const double x : v) put(static_cast<float>(x));
    for (const Triangle& t : mesh.triangles) {
      put(std::uint8_t{3});
      for (const std::uint32_t v : t) put(v);
    }
    if (!file.flush()) throw std::runtime_error("cannot write " + path);
  });
}

}  // namespace knotlight
