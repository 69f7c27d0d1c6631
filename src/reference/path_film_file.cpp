// Films on disc, so that a long render can be taken up where it was interrupted.
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "core/errors.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "reference/path_film.h"
#include "scene/scene_hash.h"

namespace knotlight {
namespace {

constexpr char magic[] = "knotlight reference film 2\n";

// The part of fixed size, after the magic words and before the two planes of sums.
struct Header {
  std::uint64_t key;
  std::uint64_t samples;
  double cpu_seconds;
};

std::uint64_t checksum(const std::string& bytes) {
  Hash hash;
  hash.bytes(bytes.data(), bytes.size());
  return hash.value();
}

template <typename T>
void append(std::string& bytes, const T* items, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(items), count * sizeof(T));
}

}  // namespace

std::uint64_t samples_key(const Scene& scene, std::uint64_t seed) {
  SceneHash hash;
  const Camera& camera = scene.camera;
  hash.add(seed);
  hash.add(scene.channels);
  hash.add(camera.type);
  for (const Vec3& v : {camera.from, camera.to, camera.up}) hash.add(v);
  hash.add(camera.type == Camera::Type::perspective ? camera.fov : camera.width);
  hash.add(camera.width_px);
  hash.add(camera.height_px);
  for (const Light& light : scene.lights) hash.add(light);
  for (const Object& object : scene.objects) {
    hash.add(object.shape);
    hash.add(object.material);
  }
  return hash.value();
}

void write_film(const std::string& path, const PathFilm& film, std::uint64_t key) {
  std::string bytes(magic);
  const Header header{key, film.samples, film.cpu_seconds};
  append(bytes, &header, 1);
  append(bytes, film.sum.data(), film.sum.size());
  append(bytes, film.sum_of_squares.data(), film.sum_of_squares.size());
  const std::uint64_t sum = checksum(bytes);
  append(bytes, &sum, 1);
  write_text_file(path, bytes);
}

PathFilm read_film(const std::string& path, const Camera& camera, std::uint64_t key) {
  const auto refuse = [&path](const char* what) -> InputError {
    return InputError(fmt::format(
        "{}: {}, expected samples of this scene and seed to go on from (remove it to start anew)",
        path, what));
  };
  std::ifstream in(path, std::ios::binary);
  if (!in) throw refuse("cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t start = sizeof(magic) - 1;
  if (bytes.compare(0, start, magic) != 0) throw refuse("is no film of this version");
  Header header{};
  std::uint64_t sum = 0;
  if (bytes.size() < start + sizeof(header) + sizeof(sum)) throw refuse("is cut short");
  std::memcpy(&header, bytes.data() + start, sizeof(header));
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof(sum), sizeof(sum));
  if (sum != checksum(bytes.substr(0, bytes.size() - sizeof(sum)))) throw refuse("is damaged");
  if (header.key != key) throw refuse("holds samples of another scene or seed");
  PathFilm film(camera);
  film.samples = header.samples;
  film.cpu_seconds = header.cpu_seconds;
  const std::size_t plane = film.sum.size() * sizeof(Spectrum);
  if (bytes.size() != start + sizeof(header) + 2 * plane + sizeof(sum))
    throw refuse("has another size than its picture");
  const char* planes = bytes.data() + start + sizeof(header);
  std::memcpy(static_cast<void*>(film.sum.data()), planes, plane);
  std::memcpy(static_cast<void*>(film.sum_of_squares.data()), planes + plane, plane);
  return film;
}

}  // namespace knotlight
