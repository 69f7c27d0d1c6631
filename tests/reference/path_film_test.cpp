#include "reference/path_film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/errors.h"
#include "reference/path_scenes.h"
#include "support/scene_files.h"

namespace knotlight {
namespace {

using namespace test;

Camera small_camera() {
  Camera camera;
  camera.type = Camera::Type::orthographic;
  camera.from = Vec3(0, 0, 5);
  camera.up = Vec3::UnitY();
  camera.width = 2.4;
  camera.width_px = 24;
  camera.height_px = 20;
  return camera;
}

class PathFilmTest : public testing::Test {
 protected:
  PathFilm filled(const std::vector<std::uint64_t>& passes, int threads,
                  std::uint64_t seed = 1) const {
    PathFilm film(small_camera());
    add(film, passes, threads, seed);
    return film;
  }
  void add(PathFilm& film, const std::vector<std::uint64_t>& passes, int threads,
           std::uint64_t seed = 1) const {
    Stages stages(false);
    Stage stage(stages, "samples", 0);
    for (const std::uint64_t pass : passes)
      add_samples(film, scene_.tracer(), small_camera(), seed, pass, Workers(threads), stage);
  }
  static void expect_same_bits(const PathFilm& a, const PathFilm& b) {
    ASSERT_EQ(a.samples, b.samples);
    for (std::size_t p = 0; p < a.sum.size(); ++p) {
      EXPECT_TRUE((a.sum[p] == b.sum[p]).all()) << p;
      EXPECT_TRUE((a.sum_of_squares[p] == b.sum_of_squares[p]).all()) << p;
    }
  }

  Traced scene_{{PointLight{Vec3(3, 0, 3), grey(18.0)}}, {ball(medium(0.1, 10.0))}};
};

TEST_F(PathFilmTest, SameBitsForAnyThreadsAndPasses) {
  const PathFilm once = filled({12}, 1);
  expect_same_bits(once, filled({12}, 2));
  expect_same_bits(once, filled({1, 2, 4, 5}, 2));
  EXPECT_FALSE((once.sum[250] == filled({12}, 1, 2).sum[250]).all());
}

// Interrupted after 5 samples, taken up from the file.
TEST_F(PathFilmTest, SameBitsFromTheFile) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.part");
  const std::uint64_t key = samples_key(scene_.scene(), 1);
  write_film(path, filled({5}, 1), key);
  PathFilm film = read_film(path, small_camera(), key);
  add(film, {7}, 1);
  expect_same_bits(film, filled({12}, 1));
}

TEST_F(PathFilmTest, WrongFilesAreRefused) {
  const ScratchFolder folder;
  const std::string path = folder.path("a.part");
  const std::uint64_t key = samples_key(scene_.scene(), 1);
  write_film(path, filled({2}, 1), key);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto refused = [&](const std::string& content, std::uint64_t wanted) -> std::string {
    folder.write("a.part", content);
    try {
      read_film(path, small_camera(), wanted);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(refused(bytes, key), "");
  EXPECT_TRUE(has(refused(bytes, key + 1), "of another scene or seed"));
  EXPECT_TRUE(has(refused(bytes.substr(0, bytes.size() - 9), key), "is damaged"));
  EXPECT_TRUE(has(refused(bytes.substr(0, 30), key), "is cut short"));
  EXPECT_TRUE(has(refused("", key), "is no film of this version"));
  EXPECT_TRUE(has(refused(replaced(bytes, "film 2", "film 0"), key), "is no film of this version"));
  std::string flipped = bytes;
  flipped[1000] = static_cast<char>(flipped[1000] ^ 1);
  EXPECT_TRUE(has(refused(flipped, key), "is damaged"));
}

TEST_F(PathFilmTest, KeyKnowsWhatDecidesTheSamples) {
  const Scene& scene = scene_.scene();
  const std::uint64_t key = samples_key(scene, 1);
  EXPECT_EQ(samples_key(scene, 1), key);
  EXPECT_NE(samples_key(scene, 2), key);
  const auto changed = [&](const std::function<void(Scene&)>& change) {
    Scene other = scene;
    change(other);
    return samples_key(other, 1) != key;
  };
  EXPECT_TRUE(changed([](Scene& s) { s.camera.width_px += 1; }));
  EXPECT_TRUE(changed([](Scene& s) { s.camera.from.x() += 1e-9; }));
  EXPECT_TRUE(changed([](Scene& s) { std::get<PointLight>(s.lights[0]).intensity[0] = 17.0; }));
  EXPECT_TRUE(changed([](Scene& s) { s.lights.emplace_back(sky(0.1)); }));
  EXPECT_TRUE(changed([](Scene& s) { std::get<Sphere>(s.objects[0].shape).radius = 0.99; }));
  EXPECT_TRUE(changed([](Scene& s) { s.objects[0].material = medium(0.1, 10.0, 0.01); }));
  EXPECT_FALSE(changed([](Scene& s) { s.camera.samples += 1; }));
  EXPECT_FALSE(changed([](Scene& s) { s.solver.tolerance = 0.5; }));
}

// The variance layer is that of the mean: over 40 films with seeds of their own, the variance of
// their means is its mean, per pixel to sqrt(2 / 39) = 23 %, over the 480 pixels together to
// sqrt(2 / 39 / lit pixels); the samples' own tails allowed for, 8 % is more than five standard
// errors.
TEST_F(PathFilmTest, VarianceIsThatOfTheMean) {
  constexpr int films = 40;
  double stated = 0.0;
  std::vector<Mean> means(24 * 20);
  for (int i = 0; i < films; ++i) {
    const PathFilm film = filled({16}, 1, static_cast<std::uint64_t>(100 + i));
    for (std::size_t p = 0; p < means.size(); ++p) {
      means[p].add(film.mean(p)[0]);
      stated += film.variance(p)[0] / films;
    }
  }
  double seen = 0.0;
  for (const Mean& mean : means) seen += std::pow(mean.standard_error(), 2) * films;
  EXPECT_NEAR(seen, stated, 0.08 * stated);
  // 16 samples of about 110 % noise each.
  EXPECT_NEAR(relative_noise(filled({16}, 1)), 0.28, 0.05);
}

TEST_F(PathFilmTest, LayersHoldMeanAndVariance) {
  const PathFilm film = filled({4}, 1);
  const std::vector<Layer> layers = film_layers(film);
  ASSERT_EQ(layers.size(), 6U);
  EXPECT_EQ(layers[0].channel, "R");
  EXPECT_EQ(layers[5].channel, "variance.B");
  EXPECT_EQ(layers[1].values[250], static_cast<float>(film.sum[250][1] / 4.0));
  EXPECT_EQ(layers[4].values[250], static_cast<float>(film.variance(250)[1]));
  EXPECT_EQ(film_image(film).at(10, 10)[2], film.sum[250][2] / 4.0);
}

}  // namespace
}  // namespace knotlight
