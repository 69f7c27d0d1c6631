// What an object can be: an exact sphere or a triangle mesh.
#pragma once

#include <variant>

#include "core/mesh.h"
#include "core/rng.h"

namespace knotlight {

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 1.0;
};

using Shape = std::variant<Sphere, TriangleMesh>;

// A point on a surface in double precision, with the outward unit normal of the true shape.
struct SurfacePoint {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};

// The same of N points: positions and outward unit normals, 3 x N each.
struct SurfaceSamples {
  Points positions;
  Points normals;
};
SurfaceSamples columns(const std::vector<SurfacePoint>& points);

Bounds bounds(const Shape& shape);
// A sphere that holds all the shapes, about the centre of the box around them; the exact one for a
// single sphere. For meshes not always the smallest.
Sphere sphere_around(const std::vector<const Shape*>& shapes);
double surface_area(const Shape& shape);
double volume(const Shape& shape);

// The triangles of a mesh that have an area, along the Morton curve through their centroids:
// neighbours on the curve are neighbours in space, so a run of triangles is a patch.
std::vector<std::uint32_t> morton_order(const TriangleMesh& mesh);

// N points spread over the surface by strata of equal area, N x (position, normal): the knots of
// [V09 ch. 7]. Sphere: about sqrt(N/2) x sqrt(2N) cells in (z, phi). Mesh: triangles in Morton
// order of their centroids, one point per N-th of the total area. Without jitter the centre of each
// stratum, with it a random point of it. Density in the mean: 1/area per area.
std::vector<SurfacePoint> stratified_surface_points(const Shape& shape, std::size_t count,
                                                    bool jitter, std::uint64_t seed,
                                                    Stream purpose);

}  // namespace knotlight
