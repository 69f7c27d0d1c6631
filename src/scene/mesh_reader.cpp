// The one file that knows assimp. It is asked for the triangles of the file and nothing else: none
// of its steps that mend or improve meshes is switched on, because make_solid must see, and report,
// what is really there.
#include "scene/mesh_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/errors.h"
#include "core/units.h"
#include "scene/mesh_repair.h"

namespace knotlight {
namespace {

[[noreturn]] void refuse(const std::string& path, std::string reason) {
  // Readers put line breaks and control characters into their messages; ours are one line.
  std::replace_if(
      reason.begin(), reason.end(), [](unsigned char c) { return c < ' '; }, ' ');
  throw InputError(fmt::format("{}: {}", path, reason));
}

void check_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(path, "no such file, expected a mesh");
  if (!std::filesystem::is_regular_file(status)) refuse(path, "is not a file, expected a mesh");
  const auto size = std::filesystem::file_size(path, error);
  if (!error && size == 0) refuse(path, "is empty, expected a mesh");
}

bool is_ply(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".ply";
}

// What has to be known of a PLY file before assimp reads it.
struct PlyFile {
  std::string mended;  // the file as assimp can read it; empty: as it is
  bool integer_colours = false;
};

// assimp's reader never comes back from a PLY header without an end, and takes line breaks that
// binary data happen to start with for more of the header. The file is mended by an edge, which it
// leaves out, of one harmless byte before its data if they start so.
PlyFile check_ply(const std::string& path) {
  constexpr std::size_t longest_header = 1 << 16;  // some 1000 lines; real ones have about 10
  std::ifstream file(path, std::ios::binary);
  PlyFile ply;
  std::string header, line, before_elements;
  bool is_binary = false, has_end = false, in_vertices = false;
  while (!has_end && header.size() < longest_header && std::getline(file, line)) {
    std::string words = line;
    words.erase(words.find_last_not_of(" \t\r") + 1);
    has_end = words == "end_header";
    is_binary = is_binary || words.rfind("format binary", 0) == 0;
    if (words.rfind("element ", 0) == 0) in_vertices = words.rfind("element vertex", 0) == 0;
    if (in_vertices && words.rfind("property ", 0) == 0 && words.ends_with("red"))
      ply.integer_colours =
          words.find("float") == std::string::npos && words.find("double") == std::string::npos;
    if (before_elements.empty() && words.rfind("element ", 0) == 0) before_elements = header;
    header += line + "\n";
  }
  if (!has_end) refuse(path, "cannot be read: the PLY header has no end_header");
  const int first = file.peek();
  if (!is_binary || before_elements.empty() || (first != '\n' && first != '\r')) return ply;
  const std::string data{std::istreambuf_iterator<char>(file), {}};
  ply.mended = before_elements + "element edge 1\nproperty uchar unused\n" +
               header.substr(before_elements.size()) + '\0' + data;
  return ply;
}

// A face without corners makes assimp take its mesh for one of polygons, and stop the program when
// it then finds none to triangulate.
void check_faces(const std::string& path, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned i = 0; i < part.mNumFaces; ++i)
      if (part.mFaces[i].mNumIndices == 0) refuse(path, "has a face without corners");
  }
}

// The triangles of one part of the file, placed by its node; points and lines are ignored.
void append(const aiMesh& part, const aiMatrix4x4& placement, TriangleMesh& mesh) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  if (part.HasVertexColors(0)) {
    mesh.colours.resize(offset, Spectrum::Ones());  // parts so far had none
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiColor4D& c = part.mColors[0][i];
      mesh.colours.emplace_back(c.r, c.g, c.b);
    }
  } else if (!mesh.colours.empty()) {
    mesh.colours.resize(offset + part.mNumVertices, Spectrum::Ones());
  }
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D v = placement * part.mVertices[i];
    mesh.vertices.emplace_back(v.x, v.y, v.z);
  }
  const bool is_mirrored = placement.Determinant() < 0;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    Triangle triangle{offset + face.mIndices[0], offset + face.mIndices[1],
                      offset + face.mIndices[2]};
    if (is_mirrored) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
}

void append_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
                 TriangleMesh& mesh) {
  const aiMatrix4x4 placement = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i)
    append(*scene.mMeshes[node.mMeshes[i]], placement, mesh);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    append_node(scene, *node.mChildren[i], placement, mesh);
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
  check_file(path);
  const PlyFile ply = is_ply(path) ? check_ply(path) : PlyFile();
  const std::string& mended = ply.mended;
  TriangleMesh mesh;
  try {
    Assimp::Importer importer;
    // Validation comes first, so that no index of a broken file leads out of its array.
    const unsigned steps = aiProcess_ValidateDataStructure;
    const aiScene* scene =
        mended.empty() ? importer.ReadFile(path, steps)
                       : importer.ReadFileFromMemory(mended.data(), mended.size(), steps, "ply");
    if (scene != nullptr) {
      check_faces(path, *scene);
      scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
    }
    if (scene == nullptr)
      refuse(path, fmt::format("cannot be read: {}", importer.GetErrorString()));
    if (scene->mRootNode != nullptr) append_node(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {  // e.g. a header that promises more than memory holds
    refuse(path, fmt::format("cannot be read: {}", error.what()));
  }
  if (mesh.triangles.empty()) refuse(path, "has no triangles, expected a surface");
  for (const Vec3& v : mesh.vertices) {
    if (!v.allFinite()) refuse(path, "has coordinates that are not finite numbers");
  }
  for (Spectrum& colour : mesh.colours) {
    if (!(colour >= 0.0).all() || !(colour <= 1.0).all())
      refuse(path, "has vertex colours that are not numbers from 0 to 1");
    if (ply.integer_colours) colour = colour.unaryExpr(&linear_from_srgb);
  }
  drop_unused_vertices(mesh);
  merge_vertices(mesh, same_position_fraction * bounds(mesh).largest_extent());
  if (mesh.triangles.empty()) refuse(path, "has only triangles without area, expected a surface");
  return mesh;
}

}  // namespace knotlight
