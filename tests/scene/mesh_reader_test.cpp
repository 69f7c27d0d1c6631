#include "scene/mesh_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/errors.h"
#include "core/rng.h"
#include "support/test_meshes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using test::icosphere;
using test::joined;
using test::moved;
using test::TemporaryFile;
using test::turned_inside_out;

// Mesh files are read in single precision: 6e-8 of the coordinates, some of it twice.
constexpr double single_precision = 3e-7;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string solid_error(const TriangleMesh& mesh) {
  return error_of([&] {
    std::vector<std::string> warnings;
    make_solid(mesh, warnings);
  });
}

std::string read_error(const std::string& extension, const std::string& content) {
  const TemporaryFile file(extension, content);
  return error_of([&] { read_mesh(file.path()); });
}

// What must hold of every solid, and the warnings, joined by " | ".
std::string expect_solid(const TriangleMesh& mesh, double volume, double tolerance) {
  std::vector<std::string> warnings;
  const TriangleMesh solid = make_solid(mesh, warnings);
  EXPECT_EQ(test::open_edges(solid), 0U);
  EXPECT_NEAR(signed_volume(solid), volume, tolerance);
  std::string all;
  for (const std::string& warning : warnings) {
    EXPECT_EQ(warning.find('\n'), std::string::npos);
    all += (all.empty() ? "" : " | ") + warning;
  }
  return all;
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' lacks '" << part << "'";
}

// ---------------------------------------------------------------- files

// Integer colours are sRGB: 188 of 255 is 0.5028865 of the light; floating-point ones are linear.
TEST(ReadMesh, ColoursOfVertices) {
  const auto ply = [](const std::string& type, const std::string& colours) {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty {0} red\nproperty {0} green\nproperty {0} blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 {1}\n1 0 0 {1}\n0 1 0 {1}\n3 0 1 2\n",
        type, colours);
  };
  const auto check = [](const std::string& extension, const std::string& content,
                        const Spectrum& expected) {
    const TemporaryFile file(extension, content);
    const TriangleMesh mesh = read_mesh(file.path());
    ASSERT_EQ(mesh.colours.size(), mesh.vertices.size());
    for (const Spectrum& colour : mesh.colours)
      EXPECT_LT((colour - expected).abs().maxCoeff(), single_precision) << extension;
  };
  check(".ply", ply("uchar", "188 255 0"), {0.5028865, 1.0, 0.0});
  check(".ply", ply("float", "0.25 1 0"), {0.25, 1.0, 0.0});
  check(".obj", "v 0 0 0 0.25 0.5 1\nv 1 0 0 0.25 0.5 1\nv 0 1 0 0.25 0.5 1\nf 1 2 3\n",
        {0.25, 0.5, 1.0});
  EXPECT_TRUE(read_mesh(TemporaryFile(".obj", test::as_obj(icosphere(1))).path()).colours.empty());
  for (const char* wrong : {"1.5 0 0", "0 -0.1 0", "0 0 nan"})
    expect_contains(read_error(".ply", ply("float", wrong)), "colours that are not numbers from 0");
}

// Where colours jump, vertices at one place stay apart; a solid's vertices are merged by place
// alone, and its colours are left out.
TEST(ReadMesh, ColoursKeepVerticesApartInSurfacesButNotInSolids) {
  TriangleMesh soup = test::triangle_soup(icosphere(0));
  for (std::size_t i = 0; i < soup.vertices.size(); ++i)
    soup.colours.push_back(Spectrum::Constant(i / 3 < 10 ? 1.0 : 0.5));
  TriangleMesh merged = soup;
  merge_vertices(merged, 0.0);
  ASSERT_EQ(merged.colours.size(), merged.vertices.size());
  EXPECT_GT(merged.vertices.size(), 12U);
  for (std::size_t t = 0; t < 20; ++t)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = merged.triangles[t][static_cast<std::size_t>(i)];
      EXPECT_EQ(merged.vertices[v], soup.corner(t, i));
      EXPECT_EQ(merged.colours[v][0], t < 10 ? 1.0 : 0.5);
    }
  std::vector<std::string> warnings;
  const TriangleMesh solid = make_solid(soup, warnings);
  EXPECT_EQ(solid.vertices.size(), 12U);
  EXPECT_TRUE(solid.colours.empty());
  ASSERT_EQ(warnings.size(), 1U);
  expect_contains(warnings[0], "vertex colours left out");
}

TEST(ReadMesh, EveryFormatGivesTheSameSolid) {
  const TriangleMesh sphere = icosphere(2, {0.3, -0.2, 5.0});
  const double volume = signed_volume(sphere);
  const auto check = [&](const std::string& extension, const std::string& content) {
    const TemporaryFile file(extension, content);
    const TriangleMesh mesh = read_mesh(file.path());
    EXPECT_EQ(mesh.vertices.size(), sphere.vertices.size()) << extension;
    EXPECT_EQ(mesh.triangles.size(), sphere.triangles.size()) << extension;
    EXPECT_EQ(test::open_edges(mesh), 0U) << extension;
    EXPECT_NEAR(signed_volume(mesh), volume, 10.0 * single_precision) << extension;
  };
  check(".obj", test::as_obj(sphere));
  check(".ply", test::as_text_ply(sphere));
  check(".stl", test::as_text_stl(sphere));
  check(".stl", test::as_binary_stl(sphere));
}

// Little-endian, single precision, lines of the header ended as given. Of the first coordinate the
// last byte of the mantissa, which comes first in the file, is `first`.
std::string as_binary_ply(const TriangleMesh& mesh, const std::string& line_end,
                          std::uint8_t first) {
  std::string text;
  for (const std::string& line :
       {std::string("ply"), std::string("format binary_little_endian 1.0"),
        fmt::format("element vertex {}", mesh.vertices.size()), std::string("property float x"),
        std::string("property float y"), std::string("property float z"),
        fmt::format("element face {}", mesh.triangles.size()),
        std::string("property list uchar int vertex_indices"), std::string("end_header")})
    text += line + line_end;
  const std::size_t data = text.size();
  const auto put = [&text](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const Vec3& v : mesh.vertices)
    for (const double x : v) put(static_cast<float>(x));
  for (const Triangle& t : mesh.triangles) {
    put(std::uint8_t{3});
    for (const std::uint32_t v : t) put(v);
  }
  text[data] = static_cast<char>(first);
  return text;
}

// A line feed or carriage return as first byte of the data is no line end of the header.
TEST(ReadMesh, BinaryPlyWhateverItsFirstByte) {
  const TriangleMesh sphere = icosphere(1, {0.3, -0.2, 5.0});
  constexpr double last_byte = 1e-5;  // a byte of the mantissa: 256 roundings of the coordinate
  for (const char* line_end : {"\n", "\r\n"})
    for (int first = 0; first < 256; ++first) {
      const TemporaryFile file(".ply",
                               as_binary_ply(sphere, line_end, static_cast<std::uint8_t>(first)));
      TriangleMesh mesh;
      ASSERT_NO_THROW(mesh = read_mesh(file.path())) << first;
      ASSERT_EQ(mesh.vertices.size(), sphere.vertices.size()) << first;
      EXPECT_EQ(mesh.triangles, sphere.triangles) << first;
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        EXPECT_LT((mesh.vertices[i] - sphere.vertices[i]).norm(), last_byte) << first;
    }
}

TEST(ReadMesh, TriangulatesPolygonsAndIgnoresLinesAndPoints) {
  const TemporaryFile file(".obj",
                           "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 3 0\nv 0 1 0\nv 7 7 7\n"
                           "f 1 2 3 4 5\nl 1 6\np 6\n");
  const TriangleMesh mesh = read_mesh(file.path());
  EXPECT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.vertices.size(), 5U);  // the vertex of line and point is not part of a surface
  EXPECT_NEAR(surface_area(mesh), 2.0 + 2.0, single_precision);
}

TEST(ReadMesh, JoinsThePartsOfAFile) {
  const TriangleMesh one = icosphere(1);
  const TriangleMesh two = moved(one, {3, 0, 0});
  std::string text = "o first\n" + test::as_obj(one) + "o second\n";
  for (const Vec3& v : two.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const Triangle& t : two.triangles)
    text += fmt::format("f {} {} {}\n", t[0] + 43, t[1] + 43, t[2] + 43);
  const TemporaryFile file(".obj", text);
  EXPECT_NEAR(signed_volume(read_mesh(file.path())), 2.0 * signed_volume(one),
              10.0 * single_precision);
}

TEST(ReadMesh, SaysWhatIsWrongInOneLine) {
  const auto check = [](const std::string& message, const std::string& part) {
    expect_contains(message, part);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  check(error_of([] { read_mesh("/nowhere/knot.ply"); }), "/nowhere/knot.ply: no such file");
  check(error_of([] { read_mesh("/"); }), "is not a file");
  check(read_error(".ply", ""), "is empty");
  check(read_error(".xyz", "1 2 3\n"), "cannot be read");
  check(read_error(".obj", "hello\n"), ".obj: ");
  check(read_error(".ply", "ply\nformat ascii 1.0\nend_header\n"), "cannot be read");
  check(read_error(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), ".obj: ");
  check(read_error(".obj", "v 0 0 0\nv 1 0 0\nv 0 1e60 0\nf 1 2 3\n"), "not finite");
  check(read_error(".obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n"), "without area");
}

TEST(ReadMesh, SurvivesIndicesOutOfRange) {
  const std::string good = test::as_text_ply(icosphere(0));
  std::string bad = good;
  bad.replace(bad.rfind("3 9 8 1"), 7, "3 9 8 77");
  expect_contains(read_error(".ply", bad), "cannot be read");
  expect_contains(read_error(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), ".obj: ");
}

// Three files that assimp answers with an endless loop or by stopping the program.
TEST(ReadMesh, SurvivesWhatItsReaderDoesNot) {
  const std::string good = test::as_text_ply(icosphere(0));
  const std::size_t end = good.find("end_header");
  std::string no_end = good;
  no_end.erase(end, 11);
  expect_contains(read_error(".ply", no_end), "end_header");
  std::string wrong_end = good;
  wrong_end[end + 10] = '0';  // was the end of the line
  expect_contains(read_error(".PLY", wrong_end), "end_header");
  std::string no_corners = good;
  no_corners.resize(no_corners.rfind("3 9 8 1"));
  no_corners += "0\n";
  expect_contains(read_error(".ply", no_corners), "without corners");
}

TEST(ReadMesh, RefusesEveryTruncationOfABinaryFile) {
  const std::string whole = test::as_binary_stl(icosphere(1));
  for (const std::size_t length : {1U, 50U, 83U, 84U, 100U, 2000U}) {
    const std::string message = read_error(".stl", whole.substr(0, length));
    EXPECT_NE(message, "no error") << length;
  }
}

// ---------------------------------------------------------------- merging

// Oracle: all pairs.
std::size_t merged_by_brute_force(const std::vector<Vec3>& points, double tolerance) {
  std::vector<std::size_t> root(points.size());
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = i;
  const std::function<std::size_t(std::size_t)> find = [&](std::size_t i) {
    return root[i] == i ? i : find(root[i]);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((points[i] - points[j]).norm() <= tolerance) root[find(i)] = find(j);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < root.size(); ++i) merged += root[i] != i ? 1 : 0;
  return merged;
}

// Random points, dense enough for chains that cross cell borders.
TEST(MergeVertices, AgreesWithBruteForce) {
  Rng rng(3, Stream::tests, 0);
  for (const double tolerance : {0.0, 0.001, 0.02, 0.05}) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 900; ++i) {
      const double x = rng.uniform();
      const double y = rng.uniform();
      mesh.vertices.emplace_back(x, y, rng.uniform());
      if (i % 5 == 0) mesh.vertices.back() = mesh.vertices[i / 2];
      if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
    }
    const std::size_t expected = merged_by_brute_force(mesh.vertices, tolerance);
    EXPECT_EQ(merge_vertices(mesh, tolerance), expected) << tolerance;
    for (const Triangle& t : mesh.triangles) {
      EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
      for (const std::uint32_t v : t) ASSERT_LT(v, mesh.vertices.size());
    }
  }
}

TEST(MergeVertices, TurnsASoupIntoAClosedMesh) {
  const TriangleMesh torus = test::torus_mesh(1.0, 0.3, 40, 20);
  TriangleMesh soup = test::triangle_soup(torus);
  Rng rng(4, Stream::tests, 0);
  for (Vec3& v : soup.vertices) {
    for (double& x : v) x += 1e-8 * (rng.uniform() - 0.5);
  }
  EXPECT_EQ(merge_vertices(soup, 1e-7), soup.triangles.size() * 3 - torus.vertices.size());
  EXPECT_EQ(soup.vertices.size(), torus.vertices.size());
  EXPECT_EQ(test::open_edges(soup), 0U);
}

// ---------------------------------------------------------------- solids

TEST(MakeSolid, LeavesASolidAlone) {
  const TriangleMesh torus = test::torus_mesh(1.0, 0.3, 40, 20);
  std::vector<std::string> warnings;
  const TriangleMesh solid = make_solid(torus, warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(solid.triangles, torus.triangles);
  EXPECT_EQ(solid.vertices, torus.vertices);
}

TEST(MakeSolid, TurnsASurfaceThatIsInsideOut) {
  const TriangleMesh sphere = icosphere(2);
  expect_contains(expect_solid(turned_inside_out(sphere), signed_volume(sphere), 1e-12),
                  "inside out");
}

TEST(MakeSolid, TurnsSingleTriangles) {
  TriangleMesh sphere = icosphere(2);
  const double volume = signed_volume(sphere);
  for (std::size_t t = 0; t < sphere.triangles.size(); t += 3)
    std::swap(sphere.triangles[t][0], sphere.triangles[t][1]);
  expect_contains(expect_solid(sphere, volume, 1e-12), "turned to face like their neighbours: 107");
}

TEST(MakeSolid, KeepsCavities) {
  const TriangleMesh outer = icosphere(2);
  const TriangleMesh hollow = joined(outer, turned_inside_out(icosphere(2, Vec3::Zero(), 0.5)));
  const double volume = signed_volume(outer) * (1.0 - 0.125);
  EXPECT_EQ(expect_solid(hollow, volume, 1e-12), "");
  // The whole file inside out: cavities turn with their solid.
  expect_contains(expect_solid(turned_inside_out(hollow), volume, 1e-12), "inside out");
}

// A ball in the cavity of a ball, in all orientations a file may give the innermost.
TEST(MakeSolid, KeepsASolidInACavity) {
  const TriangleMesh hollow =
      joined(icosphere(2), turned_inside_out(icosphere(2, Vec3::Zero(), 0.5)));
  const TriangleMesh core = icosphere(2, Vec3(0.1, 0, 0), 0.25);
  const double volume = signed_volume(icosphere(2)) * (1.0 - 0.125 + 0.015625);
  EXPECT_EQ(expect_solid(joined(hollow, core), volume, 1e-12), "");
  EXPECT_EQ(expect_solid(joined(core, hollow), volume, 1e-12), "");
  expect_contains(expect_solid(joined(hollow, turned_inside_out(core)), volume, 1e-12),
                  "inside out");
}

TEST(MakeSolid, LeavesOutWhatIsAlreadyFilled) {
  const TriangleMesh filled = joined(icosphere(2, Vec3::Zero(), 0.5), icosphere(2));
  expect_contains(expect_solid(filled, signed_volume(icosphere(2)), 1e-12), "left out");
}

TEST(MakeSolid, AcceptsSeveralPartsAndTurnsEach) {
  const TriangleMesh sphere = icosphere(2);
  const TriangleMesh pair = joined(sphere, turned_inside_out(moved(sphere, {3, 0, 0})));
  expect_contains(expect_solid(pair, 2.0 * signed_volume(sphere), 1e-12), "inside out turned: 320");
}

// The box around a ring holds the ball in its middle; its material does not.
TEST(MakeSolid, KeepsWhatLiesInTheHoleOfARing) {
  const TriangleMesh ring = test::torus_mesh(1.0, 0.3, 40, 20);
  const TriangleMesh ball = icosphere(2, Vec3::Zero(), 0.2);
  EXPECT_EQ(expect_solid(joined(ring, ball), signed_volume(ring) + signed_volume(ball), 1e-12), "");
}

TEST(MakeSolid, ToleratesPartsThatTouchAtAVertex) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const TriangleMesh pair = joined(box, box_mesh({1, 1, 1}, {2, 2, 2}));
  EXPECT_EQ(expect_solid(pair, 2.0, 1e-12), "");
}

TEST(MakeSolid, ClosesSmallHoles) {
  const TriangleMesh sphere = icosphere(5);  // edges of about 2 % of its size
  const double volume = signed_volume(sphere);
  TriangleMesh holed = test::without_triangle(sphere, 100);
  expect_contains(expect_solid(holed, volume, 1e-12), "small holes closed: 1");
  // A vertex with all its triangles: six edges, closed by a fan.
  const std::uint32_t removed = sphere.triangles[700][0];
  std::erase_if(holed.triangles, [&](const Triangle& t) {
    return t[0] == removed || t[1] == removed || t[2] == removed;
  });
  // Lost is a pyramid over a hexagon of sides 0.035 (area 3e-3), 6e-4 high.
  expect_contains(expect_solid(holed, volume, 1e-6), "small holes closed: 2");
}

TEST(MakeSolid, ClosesHolesThatMeetAtAVertex) {
  TriangleMesh sphere = icosphere(4);
  const double volume = signed_volume(sphere);
  const Triangle first = sphere.triangles[100];
  const auto shared_with_first = [&](const Triangle& t) {
    int shared = 0;
    for (const std::uint32_t v : t) shared += v == first[0] || v == first[1] || v == first[2];
    return shared;
  };
  const auto second = std::find_if(sphere.triangles.begin(), sphere.triangles.end(),
                                   [&](const Triangle& t) { return shared_with_first(t) == 1; });
  sphere.triangles.erase(second);
  std::erase(sphere.triangles, first);
  expect_contains(expect_solid(sphere, volume, 1e-12), "small holes closed: 2");
}

// A globe without the fan of `around` triangles at its north pole.
TriangleMesh globe_without_pole(std::uint32_t around) {
  constexpr std::uint32_t rings = 60;
  TriangleMesh globe;
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const double theta = pi * i / rings;
      const double phi = 2.0 * pi * j / around;
      globe.vertices.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                  std::cos(theta));
    }
  }
  const auto south = static_cast<std::uint32_t>(globe.vertices.size());
  globe.vertices.emplace_back(0, 0, -1);
  for (std::uint32_t j = 0; j < around; ++j) {
    const std::uint32_t k = (j + 1) % around;
    for (std::uint32_t row = 0; row + around < south; row += around) {
      globe.triangles.push_back({row + j, row + around + j, row + around + k});
      globe.triangles.push_back({row + j, row + around + k, row + k});
    }
    globe.triangles.push_back({south - around + j, south, south - around + k});
  }
  return globe;
}

TEST(MakeSolid, ClosesHolesOfUpTo32Edges) {
  std::vector<std::string> warnings;
  EXPECT_EQ(test::open_edges(make_solid(globe_without_pole(32), warnings)), 0U);
  expect_contains(solid_error(globe_without_pole(33)), "hole of 33 edges");
}

TEST(MakeSolid, RefusesLargeHolesAndSaysWhere) {
  TriangleMesh bowl = icosphere(3);
  std::erase_if(bowl.triangles, [&](const Triangle& t) {
    return bowl.vertices[t[0]].z() > 0.9 || bowl.vertices[t[1]].z() > 0.9 ||
           bowl.vertices[t[2]].z() > 0.9;
  });
  const std::string message = solid_error(bowl);
  expect_contains(message, "hole of ");
  expect_contains(message, "edges around (");
  // One triangle missing in a coarse mesh is a large hole.
  expect_contains(solid_error(test::without_triangle(icosphere(0), 3)), "hole of 3 edges");
}

TEST(MakeSolid, RefusesAlsoTheOneOfManyHolesThatIsLarge) {
  TriangleMesh sphere = test::without_triangle(icosphere(4), 5);
  std::erase_if(sphere.triangles,
                [&](const Triangle& t) { return sphere.vertices[t[0]].x() > 0.8; });
  expect_contains(solid_error(sphere), "hole of ");
  EXPECT_EQ(solid_error(sphere).find("more"), std::string::npos);
}

TEST(MakeSolid, RefusesEdgesWithThreeTriangles) {
  TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  box.vertices.emplace_back(0.5, -1.0, 0.0);
  box.triangles.push_back({0, 1, 8});
  EXPECT_EQ(solid_error(box),
            "edge between (0, 0, 0) and (1, 0, 0) belongs to 3 triangles, expected 2 at every edge "
            "of a solid");
}

TEST(MakeSolid, RefusesOneSidedSurfaces) {
  expect_contains(solid_error(test::twisted_strip(40, 1)), "one-sided");
  expect_contains(solid_error(test::twisted_strip(40, 2)), "hole of ");  // two-sided, but open
}

// A torus whose tube is glued to itself the other way round: closed, without an inside.
TEST(MakeSolid, RefusesAKleinBottle) {
  constexpr int around = 24;
  constexpr int across = 12;
  TriangleMesh bottle = test::torus_mesh(1.0, 0.4, around, across);
  for (std::size_t t = 2 * (around - 1) * across; t < bottle.triangles.size(); ++t)
    for (std::uint32_t& v : bottle.triangles[t])
      if (v < across) v = (across - v) % across;  // the seam's first ring, mirrored
  expect_contains(solid_error(bottle), "one-sided");
}

TEST(MakeSolid, RefusesWhatHasNoVolume) {
  expect_contains(solid_error({}), "no triangles");
  const TriangleMesh single{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  expect_contains(solid_error(single), "hole of 3 edges");
  const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  expect_contains(solid_error(sheet), "no volume");
  const TriangleMesh flat_box = box_mesh({0, 0, 0}, {1, 1, 1e-9});
  EXPECT_NE(solid_error(flat_box), "no error");
  TriangleMesh not_finite = icosphere(0);
  not_finite.vertices[3].y() = std::nan("");
  expect_contains(solid_error(not_finite), "vertex 3");
}

// A cube one of whose edges carries `extra` vertices on one side only, joined to the other side by
// triangles without area, as exporters do.
TriangleMesh box_with_flat_triangles(std::uint32_t extra) {
  TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const Triangle first = box.triangles[0];
  std::uint32_t before = first[0];
  box.triangles.erase(box.triangles.begin());
  for (std::uint32_t i = 0; i <= extra; ++i) {
    const double fraction = (i + 1.0) / (extra + 1.0);
    const auto vertex = i == extra ? first[1] : static_cast<std::uint32_t>(box.vertices.size());
    if (i < extra)
      box.vertices.push_back(box.vertices[first[0]] +
                             fraction * (box.vertices[first[1]] - box.vertices[first[0]]));
    box.triangles.push_back({before, vertex, first[2]});
    if (i > 0) box.triangles.push_back({first[0], vertex, before});
    before = vertex;
  }
  return box;
}

TEST(MakeSolid, TakesOutTrianglesWithoutArea) {
  for (const std::uint32_t extra : {1U, 2U, 7U}) {
    const TriangleMesh box = box_with_flat_triangles(extra);
    ASSERT_EQ(test::open_edges(box), 0U);
    std::vector<std::string> warnings;
    const TriangleMesh solid = make_solid(box, warnings);
    EXPECT_EQ(test::open_edges(solid), 0U);
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) EXPECT_GT(solid.area(t), 0.02);
    EXPECT_NEAR(signed_volume(solid), 1.0, 1e-12);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0], fmt::format("triangles without area taken out: {}", extra));
  }
}

TEST(MakeSolid, RefusesTrianglesWithoutAreaThatStay) {
  expect_contains(solid_error(box_with_flat_triangles(300)), "triangle without area at (");
}

// The same crack without its triangle, a T-junction: a slit of three edges, closed, then evened.
TEST(MakeSolid, ClosesSlitsAtTJunctions) {
  TriangleMesh sphere = icosphere(4);
  const double volume = signed_volume(sphere);
  const Triangle t = sphere.triangles[11];
  const auto middle = static_cast<std::uint32_t>(sphere.vertices.size());
  sphere.vertices.push_back(0.5 * (sphere.vertices[t[0]] + sphere.vertices[t[1]]));
  sphere.triangles[11] = {t[0], middle, t[2]};
  sphere.triangles.push_back({middle, t[1], t[2]});
  std::vector<std::string> warnings;
  const TriangleMesh solid = make_solid(sphere, warnings);
  EXPECT_EQ(test::open_edges(solid), 0U);
  EXPECT_NEAR(signed_volume(solid), volume, 1e-12);
  for (std::size_t i = 0; i < solid.triangles.size(); ++i) EXPECT_GT(solid.area(i), 1e-4);
}

// ---------------------------------------------------------------- crossings

// Oracle: two triangles in general position cross where an edge of one goes through the other.
bool edge_goes_through(const TriangleMesh& mesh, std::size_t edges_of, std::size_t other) {
  for (int i = 0; i < 3; ++i) {
    const Vec3& p = mesh.corner(edges_of, i);
    const Vec3& q = mesh.corner(edges_of, (i + 1) % 3);
    Eigen::Matrix3d system;  // p + s (q - p) = a + u (b - a) + v (c - a)
    system.col(0) = p - q;
    system.col(1) = mesh.corner(other, 1) - mesh.corner(other, 0);
    system.col(2) = mesh.corner(other, 2) - mesh.corner(other, 0);
    const Vec3 suv = system.inverse() * (p - mesh.corner(other, 0));
    if (suv.minCoeff() > 0.0 && suv.x() < 1.0 && suv.y() + suv.z() < 1.0) return true;
  }
  return false;
}

TEST(IntersectingTriangles, AgreeWithBruteForce) {
  Rng rng(5, Stream::tests, 0);
  TriangleMesh mesh;
  const auto random = [&] {
    const double x = rng.uniform();
    const double y = rng.uniform();
    return Vec3(x, y, rng.uniform());
  };
  for (std::uint32_t t = 0; t < 400; ++t) {
    const Vec3 at = random();
    for (int i = 0; i < 3; ++i) mesh.vertices.push_back(at + 0.3 * random());
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  std::vector<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t a = 0; a < 400; ++a)
    for (std::size_t b = a + 1; b < 400; ++b)
      if (edge_goes_through(mesh, a, b) || edge_goes_through(mesh, b, a))
        expected.emplace_back(a, b);
  auto found = intersecting_triangles(mesh, 1'000'000);
  std::sort(found.begin(), found.end());
  EXPECT_GT(expected.size(), 200U);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(intersecting_triangles(mesh, 7).size(), 7U);
}

// A corner of one triangle lies in the plane of the other, inside it, at its border, and beyond.
TEST(IntersectingTriangles, CornerInThePlane) {
  for (const double x : {0.2, 0.5, 0.8}) {
    TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {x, 0.5, 0}, {2, 0.5, -1}, {2, 0.5, 1}},
                      {{0, 1, 2}, {3, 4, 5}}};
    EXPECT_EQ(intersecting_triangles(mesh, 10).size(), x < 0.5 ? 1U : 0U) << x;
  }
}

TEST(IntersectingTriangles, TouchingIsNotCrossing) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(intersecting_triangles(box, 10).empty());
  EXPECT_TRUE(intersecting_triangles(joined(box, box_mesh({1, 0, 0}, {2, 1, 1})), 10).empty());
  EXPECT_TRUE(intersecting_triangles(joined(box, box_mesh({1, .2, .3}, {2, .7, .9})), 10).empty());
  EXPECT_FALSE(
      intersecting_triangles(joined(box, box_mesh({0.9, .2, .3}, {2, .7, .9})), 10).empty());
}

TEST(MakeSolid, WarnsOfFewCrossingsAndRefusesMany) {
  // Two balls of 5120 triangles whose skins dip into each other at one spot, or along a circle.
  const TriangleMesh ball = icosphere(4);
  const TriangleMesh dipping = joined(ball, moved(ball, {1.9985, 0.01, 0.02}));
  expect_contains(expect_solid(dipping, 2.0 * signed_volume(ball), 1e-9), "triangles cross others");
  expect_contains(solid_error(joined(ball, moved(ball, {1.2, 0, 0}))), "triangles cross others");
}

// ---------------------------------------------------------------- the knot of the scenes

// A tube of radius r along a closed curve of length L encloses pi r^2 L (Pappus); the polygon of 38
// vertices around it encloses sin(x) / x of that, x = 2 pi / 38.
TEST(Knot, IsASoundSolid) {
  const TriangleMesh knot = read_mesh(KNOTLIGHT_ROOT "/scenes/meshes/knot.ply");
  const double x = 2.0 * pi / 38.0;
  const double volume = pi * 0.3 * 0.3 * 14.9201 * std::sin(x) / x;
  // Chords instead of bends between rings lose about (0.05 curvature)^2 / 8 of it.
  EXPECT_EQ(expect_solid(knot, volume, 1e-3 * volume), "");
  EXPECT_EQ(knot.triangles.size(), 22876U);
  EXPECT_TRUE(intersecting_triangles(knot, 1).empty());
  EXPECT_LT(bounds(knot).center().norm(), 1e-6);
  EXPECT_NEAR(bounds(knot).largest_extent(), 3.28, 0.01);
  // Nearly square cells: bends stretch the outer side to 1 + r / (bend radius), about 1.5.
  EXPECT_LT(test::longest_edge(knot), 0.0496 * std::sqrt(1.0 + 1.6 * 1.6));
}

}  // namespace
}  // namespace knotlight
