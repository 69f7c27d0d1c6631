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

#include "core/errors.h"
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

// The PLY reader never comes back from a header without an end.
void check_ply_header(const std::string& path) {
  constexpr std::size_t longest_header = 1 << 16;  // some 1000 lines; real ones have about 10
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".ply") return;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (std::size_t read = 0; read < longest_header && std::getline(file, line);
       read += line.size() + 1) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (line == "end_header") return;
  }
  refuse(path, "cannot be read: the PLY header has no end_header");
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
  check_ply_header(path);
  TriangleMesh mesh;
  try {
    Assimp::Importer importer;
    // Validation comes first, so that no index of a broken file leads out of its array.
    const aiScene* scene = importer.ReadFile(path, aiProcess_ValidateDataStructure);
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
  drop_unused_vertices(mesh);
  merge_vertices(mesh, same_position_fraction * bounds(mesh).largest_extent());
  if (mesh.triangles.empty()) refuse(path, "has only triangles without area, expected a surface");
  return mesh;
}

}  // namespace knotlight
