#include "trace/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/errors.h"

namespace knotlight {
namespace {

// Depth up to which solids count as touching, of the smaller one's size: positions in mesh files
// are known to about a tenth of it.
constexpr double touching_fraction = 1e-6;

// How far under its own surface a solid is asked whether it lies in the other, in tolerances:
// clearly more than the depth that counts.
constexpr double probe_depth = 4.0;

// An object of the scene with what is asked of it.
struct Solid {
  const RayCaster& caster;
  std::uint32_t index;
  const Shape& shape;
  Bounds box;

  // Is p inside, and further than `tolerance` from the surface?
  bool holds(const Vec3& p, double tolerance) const {
    return caster.inside(p, index) &&
           (caster.nearest_surface_point(p, index).position - p).norm() > tolerance;
  }
};

bool boxes_meet(const Bounds& a, const Bounds& b, double tolerance) {
  return ((a.lo.array() + tolerance) < b.hi.array()).all() &&
         ((b.lo.array() + tolerance) < a.hi.array()).all();
}

Bounds box_of(std::initializer_list<Vec3> points) {
  Bounds box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

std::optional<Vec3> common_point(const Sphere& a, const Sphere& b, double tolerance) {
  const Vec3 between = b.center - a.center;
  const double distance = between.norm();
  if (distance >= a.radius + b.radius - tolerance) return std::nullopt;
  return distance > 0.0 ? Vec3(a.center + std::min(a.radius, distance) / distance * between)
                        : a.center;
}

// A ball and a solid overlap if the centre is inside, or the surface comes nearer than the radius.
std::optional<Vec3> common_point(const Sphere& ball, const Solid& solid, double tolerance) {
  if (solid.holds(ball.center, tolerance)) return ball.center;
  const Vec3 nearest = solid.caster.nearest_surface_point(ball.center, solid.index).position;
  if ((nearest - ball.center).norm() < ball.radius - tolerance) return nearest;
  return std::nullopt;
}

// The middle of a stretch of the edge a - b that lies inside the solid.
std::optional<Vec3> edge_inside(const Vec3& a, const Vec3& b, const Solid& solid,
                                double tolerance) {
  const double length = (b - a).norm();
  const Ray ray{a, (b - a) / length};
  double entered = 0.0;
  for (const RayCaster::Crossing& crossing : solid.caster.crossings(ray, solid.index)) {
    if (crossing.leaving) {
      const Vec3 middle = a + 0.5 * (entered + std::min(crossing.t, length)) * ray.direction;
      if (solid.holds(middle, tolerance)) return middle;
    }
    if (crossing.t >= length) break;
    entered = crossing.t;
  }
  return std::nullopt;
}

// A point of mesh `a` inside `b`: the middle of a stretch of an edge, or a point just under a
// facet, which also finds solids that coincide.
std::optional<Vec3> point_inside(const Solid& a, const TriangleMesh& mesh, const Solid& b,
                                 double tolerance) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3& p = mesh.corner(t, 0);
    const Vec3& q = mesh.corner(t, 1);
    const Vec3& r = mesh.corner(t, 2);
    if (!boxes_meet(box_of({p, q, r}), b.box, -tolerance)) continue;
    const Vec3 probe = (p + q + r) / 3.0 - probe_depth * tolerance * mesh.normal(t);
    if (b.holds(probe, tolerance) && a.holds(probe, tolerance)) return probe;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][i];
      const std::uint32_t to = mesh.triangles[t][(i + 1) % 3];
      if (from > to) continue;  // its neighbour has the same edge the other way round
      auto found = edge_inside(mesh.vertices[from], mesh.vertices[to], b, tolerance);
      if (found) return found;
    }
  }
  return std::nullopt;
}

std::optional<Vec3> common_point(const Solid& a, const Solid& b, double tolerance) {
  const auto* sphere_a = std::get_if<Sphere>(&a.shape);
  const auto* sphere_b = std::get_if<Sphere>(&b.shape);
  if (sphere_a != nullptr && sphere_b != nullptr)
    return common_point(*sphere_a, *sphere_b, tolerance);
  if (sphere_a != nullptr) return common_point(*sphere_a, b, tolerance);
  if (sphere_b != nullptr) return common_point(*sphere_b, a, tolerance);
  auto found = point_inside(a, std::get<TriangleMesh>(a.shape), b, tolerance);
  if (found) return found;
  return point_inside(b, std::get<TriangleMesh>(b.shape), a, tolerance);
}

// Whether an edge of the mesh crosses the surface of the other object away from its ends.
bool pierces(const TriangleMesh& mesh, const Solid& other, double tolerance) {
  for (const Triangle& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.vertices[triangle[i]];
      const Vec3 along = mesh.vertices[triangle[(i + 1) % 3]] - a;
      const double length = along.norm();
      if (length <= 2.0 * tolerance) continue;
      const Ray ray{a, along / length, length - tolerance};
      const auto hit = other.caster.nearest(ray, other.index);
      if (hit && hit->t > tolerance) return true;
    }
  return false;
}

// Whether a triangle comes nearer to the centre than the radius.
bool reaches_into(const TriangleMesh& mesh, const Sphere& ball, double tolerance) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 nearest = nearest_point_on_triangle(ball.center, mesh.corner(t, 0),
                                                   mesh.corner(t, 1), mesh.corner(t, 2));
    if ((nearest - ball.center).norm() < ball.radius - tolerance) return true;
  }
  return false;
}

}  // namespace

void refuse_overlaps(const Scene& scene, const RayCaster& caster) {
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (object.translucent() != nullptr) {
      solids.push_back({caster, static_cast<std::uint32_t>(i), object.shape, bounds(object.shape)});
    }
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t j = i + 1; j < solids.size(); ++j) {
      const double smaller =
          std::min(solids[i].box.largest_extent(), solids[j].box.largest_extent());
      // Nearer than its skip distance the ray caster cannot tell inside from outside.
      const double tolerance = std::max(touching_fraction * smaller, caster.skip_distance());
      if (!boxes_meet(solids[i].box, solids[j].box, tolerance)) continue;
      const auto found = common_point(solids[i], solids[j], tolerance);
      if (!found) continue;
      throw InputError(fmt::format(
          "objects '{}' and '{}' overlap around ({:.4g}, {:.4g}, {:.4g}), expected translucent "
          "objects that at most touch",
          scene.objects[solids[i].index].name, scene.objects[solids[j].index].name, found->x(),
          found->y(), found->z()));
    }
  }
}

std::vector<std::string> opaque_inclusions(const Scene& scene, const RayCaster& caster) {
  const auto solid = [&](std::size_t i) {
    const Shape& shape = scene.objects[i].shape;
    return Solid{caster, static_cast<std::uint32_t>(i), shape, bounds(shape)};
  };
  std::vector<std::string> found;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].translucent() == nullptr) continue;
    const Solid wax = solid(i);
    const double tolerance =
        std::max(touching_fraction * wax.box.largest_extent(), caster.skip_distance());
    for (std::size_t j = 0; j < scene.objects.size(); ++j) {
      if (scene.objects[j].translucent() != nullptr) continue;
      const Solid opaque = solid(j);
      if (!boxes_meet(wax.box, opaque.box, tolerance)) continue;
      const auto* mesh = std::get_if<TriangleMesh>(&opaque.shape);
      // An open surface has no inside: its own points in the wax, and the wax's edges through it.
      const auto common = mesh == nullptr ? common_point(wax, opaque, tolerance)
                                          : point_inside(opaque, *mesh, wax, tolerance);
      const auto* wax_mesh = std::get_if<TriangleMesh>(&wax.shape);
      const bool pierced =
          !common && mesh != nullptr &&
          (wax_mesh != nullptr ? pierces(*wax_mesh, opaque, tolerance)
                               : reaches_into(*mesh, std::get<Sphere>(wax.shape), tolerance));
      if (common || pierced)
        found.push_back(fmt::format("object '{}' reaches into '{}'", scene.objects[j].name,
                                    scene.objects[i].name));
    }
  }
  return found;
}

}  // namespace knotlight
