#include "trace/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace knotlight {
namespace {

constexpr double skip_fraction = 1e-7;  // ~1e9 roundings of double, yet below any modelled detail

// Generic directions for inside tests: not aligned with the axes, diagonals or symmetry planes that
// modelled shapes are full of.
const Vec3 probe_directions[3] = {Vec3(0.5360, 0.3571, 0.7650).normalized(),
                                  Vec3(-0.7127, 0.6123, 0.3423).normalized(),
                                  Vec3(0.1391, -0.8214, -0.5532).normalized()};

struct TriangleHit {
  double t, b1, b2;
};

// The crossing of a ray with the plane of a triangle in double precision; barycentric coordinates
// are clamped to the triangle, since Embree has already decided that it is hit.
std::optional<TriangleHit> hit_triangle(const Ray& ray, const Vec3& a, const Vec3& b,
                                        const Vec3& c) {
  const Vec3 e1 = b - a;
  const Vec3 e2 = c - a;
  const Vec3 p = ray.direction.cross(e2);
  const double det = e1.dot(p);
  if (det == 0.0) return std::nullopt;
  const Vec3 s = ray.origin - a;
  const Vec3 q = s.cross(e1);
  const double b1 = std::clamp(s.dot(p) / det, 0.0, 1.0);
  const double b2 = std::clamp(ray.direction.dot(q) / det, 0.0, 1.0 - b1);
  return TriangleHit{e2.dot(q) / det, b1, b2};
}

// Both crossings of a ray with a sphere, t increasing; computed about the point of the ray nearest
// to the centre, which keeps the digits that the usual quadratic formula loses.
std::optional<std::pair<double, double>> hit_sphere(const Ray& ray, const Sphere& sphere) {
  const Vec3 to_center = sphere.center - ray.origin;
  const double t_near_center = to_center.dot(ray.direction);
  const double distance2 = (to_center - t_near_center * ray.direction).squaredNorm();
  const double half_chord2 = sphere.radius * sphere.radius - distance2;
  if (half_chord2 < 0.0) return std::nullopt;
  const double half_chord = std::sqrt(half_chord2);
  return std::pair{t_near_center - half_chord, t_near_center + half_chord};
}

// A sphere's hit position, put onto it exactly.
void place_on_sphere(const Ray& ray, const Sphere& sphere, Hit& hit) {
  hit.normal = (ray.origin + hit.t * ray.direction - sphere.center).normalized();
  hit.position = sphere.center + sphere.radius * hit.normal;
}

// What the Embree callbacks need beside Embree's own arguments.
struct QueryContext {
  RTCIntersectContext base;  // first: Embree hands back a pointer to it
  const Ray* ray;
  double skip;
  std::vector<RayCaster::Crossing>* all;  // not null: collect every crossing, accept none
};

// One shape as Embree knows it; the geometry's user pointer.
struct EmbreeShape {
  const TriangleMesh* mesh = nullptr;
  const Sphere* sphere = nullptr;
  double scale = 1.0;  // world to Embree
  Vec3 center;         // world point at Embree's origin
};

// Decides in double precision whether a triangle that Embree found counts.
void triangle_filter(const RTCFilterFunctionNArguments* args) {
  auto* context = reinterpret_cast<QueryContext*>(args->context);
  const auto* shape = static_cast<const EmbreeShape*>(args->geometryUserPtr);
  const auto* rtc_hit = reinterpret_cast<const RTCHit*>(args->hit);
  const TriangleMesh& mesh = *shape->mesh;
  const auto exact = hit_triangle(*context->ray, mesh.corner(rtc_hit->primID, 0),
                                  mesh.corner(rtc_hit->primID, 1), mesh.corner(rtc_hit->primID, 2));
  const bool counts = exact && exact->t > context->skip && exact->t < context->ray->t_max;
  if (counts && context->all != nullptr) {
    const bool leaving = mesh.area_vector(rtc_hit->primID).dot(context->ray->direction) > 0.0;
    context->all->push_back({exact->t, leaving});
  }
  if (!counts || context->all != nullptr) args->valid[0] = 0;
}

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  const auto* shape = static_cast<const EmbreeShape*>(args->geometryUserPtr);
  // One part in 1e6 of slack covers the rounding of the box to float.
  const double r = shape->sphere->radius * shape->scale * (1.0 + 1e-6);
  const Vec3 c = (shape->sphere->center - shape->center) * shape->scale;
  RTCBounds& b = *args->bounds_o;
  b.lower_x = static_cast<float>(c.x() - r) - 1e-6F;
  b.lower_y = static_cast<float>(c.y() - r) - 1e-6F;
  b.lower_z = static_cast<float>(c.z() - r) - 1e-6F;
  b.upper_x = static_cast<float>(c.x() + r) + 1e-6F;
  b.upper_y = static_cast<float>(c.y() + r) + 1e-6F;
  b.upper_z = static_cast<float>(c.z() + r) + 1e-6F;
}

// The sphere's first crossing that counts, in Embree's length unit; negative if there is none.
float sphere_distance(const EmbreeShape& shape, const QueryContext& context, float t_far) {
  const auto roots = hit_sphere(*context.ray, *shape.sphere);
  if (!roots) return -1.0F;
  for (const double t : {roots->first, roots->second}) {
    const auto t_embree = static_cast<float>(t * shape.scale);
    if (t > context.skip && t < context.ray->t_max && t_embree < t_far) return t_embree;
  }
  return -1.0F;
}

void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto* context = reinterpret_cast<const QueryContext*>(args->context);
  const auto* shape = static_cast<const EmbreeShape*>(args->geometryUserPtr);
  auto* ray_hit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  const float t = sphere_distance(*shape, *context, ray_hit->ray.tfar);
  if (t < 0.0F) return;
  ray_hit->ray.tfar = t;
  ray_hit->hit.geomID = args->geomID;
  ray_hit->hit.primID = 0;
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto* context = reinterpret_cast<const QueryContext*>(args->context);
  const auto* shape = static_cast<const EmbreeShape*>(args->geometryUserPtr);
  auto* ray = reinterpret_cast<RTCRay*>(args->ray);
  if (sphere_distance(*shape, *context, ray->tfar) >= 0.0F)
    ray->tfar = -std::numeric_limits<float>::infinity();
}

struct NearestQuery {
  const EmbreeShape* shape;
  Vec3 p;
  double square;  // of the distance found so far
  Vec3 position;
  std::uint32_t primitive;
};

// Slack for the float rounding of the query: candidates at the same distance are still visited.
float query_radius(double distance) {
  return static_cast<float>(distance * (1.0 + 1e-5)) + 1e-6F;
}

bool nearest_callback(RTCPointQueryFunctionArguments* args) {
  auto* query = static_cast<NearestQuery*>(args->userPtr);
  const TriangleMesh& mesh = *query->shape->mesh;
  const Vec3 q =
      nearest_point_on_triangle(query->p, mesh.corner(args->primID, 0),
                                mesh.corner(args->primID, 1), mesh.corner(args->primID, 2));
  const double square = (q - query->p).squaredNorm();
  if (square >= query->square) return false;
  query->square = square;
  query->position = q;
  query->primitive = args->primID;
  args->query->radius = query_radius(std::sqrt(square) * query->shape->scale);
  return true;
}

}  // namespace

struct RayCaster::Implementation {
  RTCDevice device = nullptr;
  RTCScene all = nullptr;
  std::vector<RTCScene>
      single;  // one scene per object; null for spheres, which are solved directly
  std::vector<Shape> shapes;
  std::vector<Bounds> boxes;
  std::vector<EmbreeShape> embree_shapes;
  double scale = 1.0;
  Vec3 center = Vec3::Zero();
  double skip = 0.0;

  ~Implementation() {
    for (RTCScene scene : single)
      if (scene != nullptr) rtcReleaseScene(scene);
    if (all != nullptr) rtcReleaseScene(all);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  RTCScene new_scene() const {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                       RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    return scene;
  }

  RTCGeometry new_geometry(const EmbreeShape& shape) const {
    if (shape.sphere != nullptr) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryUserPrimitiveCount(geometry, 1);
      rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
      rtcSetGeometryIntersectFunction(geometry, sphere_intersect);
      rtcSetGeometryOccludedFunction(geometry, sphere_occluded);
      return geometry;
    }
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const TriangleMesh& mesh = *shape.mesh;
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    if (vertices == nullptr || indices == nullptr)
      throw std::runtime_error("Embree could not allocate the mesh's buffers");
    for (const Vec3& v : mesh.vertices)
      for (const double x : Vec3((v - center) * scale)) *vertices++ = static_cast<float>(x);
    for (const Triangle& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle) *indices++ = index;
    rtcSetGeometryIntersectFilterFunction(geometry, triangle_filter);
    rtcSetGeometryOccludedFilterFunction(geometry, triangle_filter);
    return geometry;
  }

  RTCRayHit to_embree(const Ray& ray) const {
    RTCRayHit query{};
    const Vec3 o = (ray.origin - center) * scale;
    query.ray.org_x = static_cast<float>(o.x());
    query.ray.org_y = static_cast<float>(o.y());
    query.ray.org_z = static_cast<float>(o.z());
    query.ray.dir_x = static_cast<float>(ray.direction.x());
    query.ray.dir_y = static_cast<float>(ray.direction.y());
    query.ray.dir_z = static_cast<float>(ray.direction.z());
    query.ray.tnear = 0.0F;
    // Slack, so that the decision at t_max is the double-precision one.
    query.ray.tfar = static_cast<float>(ray.t_max * scale * (1.0 + 1e-5)) + 1e-5F;
    query.ray.mask = 0xffffffffU;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
  }

  QueryContext context(const Ray& ray, std::vector<Crossing>* collect = nullptr) const {
    QueryContext c{};
    rtcInitIntersectContext(&c.base);
    c.ray = &ray;
    c.skip = skip;
    c.all = collect;
    return c;
  }

  std::optional<Hit> nearest(RTCScene scene, const Ray& ray) const {
    RTCRayHit query = to_embree(ray);
    QueryContext c = context(ray);
    rtcIntersect1(scene, &c.base, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    Hit hit;
    hit.object = query.hit.geomID;
    hit.primitive = query.hit.primID;
    const EmbreeShape& shape = embree_shapes[hit.object];
    if (shape.sphere != nullptr) {
      const auto roots = hit_sphere(ray, *shape.sphere);
      hit.t = roots->first > skip ? roots->first : roots->second;
      place_on_sphere(ray, *shape.sphere, hit);
      return hit;
    }
    const TriangleMesh& mesh = *shape.mesh;
    const Vec3& a = mesh.corner(hit.primitive, 0);
    const Vec3& b = mesh.corner(hit.primitive, 1);
    const Vec3& c3 = mesh.corner(hit.primitive, 2);
    const auto exact = hit_triangle(ray, a, b, c3);  // has a value: the filter let it through
    hit.t = exact->t;
    hit.b1 = exact->b1;
    hit.b2 = exact->b2;
    hit.position = (1.0 - hit.b1 - hit.b2) * a + hit.b1 * b + hit.b2 * c3;
    hit.normal = mesh.normal(hit.primitive);
    return hit;
  }

  // All crossings with the object's surface, t increasing, up to infinity; the same sheet met twice
  // at a shared edge counts once.
  std::vector<Crossing> all_crossings(const Ray& ray, std::uint32_t object) const {
    std::vector<Crossing> found;
    const EmbreeShape& shape = embree_shapes[object];
    if (shape.sphere != nullptr) {
      if (const auto roots = hit_sphere(ray, *shape.sphere)) {
        if (roots->first > skip) found.push_back({roots->first, false});
        if (roots->second > skip) found.push_back({roots->second, true});
      }
      return found;
    }
    Ray endless = ray;
    endless.t_max = std::numeric_limits<double>::infinity();
    RTCRayHit query = to_embree(endless);
    QueryContext c = context(endless, &found);
    rtcIntersect1(single[object], &c.base, &query);
    std::sort(found.begin(), found.end(),
              [](const Crossing& x, const Crossing& y) { return x.t < y.t; });
    const auto same_sheet = [this](const Crossing& x, const Crossing& y) {
      return x.leaving == y.leaving && y.t - x.t < skip;
    };
    found.erase(std::unique(found.begin(), found.end(), same_sheet), found.end());
    return found;
  }

  // How many times the surface winds around p, by the crossings of one ray.
  int winding(const Vec3& p, std::uint32_t object, const Vec3& direction) const {
    int depth = 0;
    for (const Crossing& crossing : all_crossings({p, direction}, object))
      depth += crossing.leaving ? 1 : -1;
    return depth;
  }
};

RayCaster::RayCaster(const std::vector<const Shape*>& shapes)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& self = *implementation_;
  Bounds box;
  for (const Shape* shape : shapes) {
    self.shapes.push_back(*shape);
    self.boxes.push_back(bounds(*shape));
    box.extend(self.boxes.back().lo);
    box.extend(self.boxes.back().hi);
  }
  // Embree works in floats around the origin at unit size, wherever the scene is and how large.
  self.center = shapes.empty() ? Vec3(Vec3::Zero()) : box.center();
  const double radius = shapes.empty() ? 1.0 : box.radius();
  self.scale = 1.0 / radius;
  self.skip = skip_fraction * radius;

  self.device = rtcNewDevice("threads=1");
  if (self.device == nullptr) throw std::runtime_error("Embree could not start");
  self.all = self.new_scene();
  for (const Shape& shape : self.shapes)
    self.embree_shapes.push_back(
        {std::get_if<TriangleMesh>(&shape), std::get_if<Sphere>(&shape), self.scale, self.center});
  for (std::size_t i = 0; i < self.shapes.size(); ++i) {
    const EmbreeShape& shape = self.embree_shapes[i];
    RTCGeometry geometry = self.new_geometry(shape);
    rtcSetGeometryUserData(geometry, const_cast<EmbreeShape*>(&shape));
    rtcCommitGeometry(geometry);
    const auto id = static_cast<unsigned>(i);
    rtcAttachGeometryByID(self.all, geometry, id);
    self.single.push_back(nullptr);
    if (shape.mesh != nullptr) {
      self.single.back() = self.new_scene();
      rtcAttachGeometryByID(self.single.back(), geometry, id);
      rtcCommitScene(self.single.back());
    }
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(self.all);
  if (rtcGetDeviceError(self.device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree could not build the scene");
}

RayCaster::~RayCaster() = default;

double RayCaster::skip_distance() const {
  return implementation_->skip;
}

std::optional<Hit> RayCaster::nearest(const Ray& ray) const {
  return implementation_->nearest(implementation_->all, ray);
}

std::optional<Hit> RayCaster::nearest(const Ray& ray, std::uint32_t object) const {
  const EmbreeShape& shape = implementation_->embree_shapes[object];
  if (shape.sphere == nullptr)
    return implementation_->nearest(implementation_->single[object], ray);
  const auto roots = hit_sphere(ray, *shape.sphere);
  if (!roots) return std::nullopt;
  Hit hit;
  hit.object = object;
  hit.t = roots->first > skip_distance() ? roots->first : roots->second;
  if (hit.t <= skip_distance() || hit.t >= ray.t_max) return std::nullopt;
  place_on_sphere(ray, *shape.sphere, hit);
  return hit;
}

bool RayCaster::occluded(const Ray& ray) const {
  RTCRayHit query = implementation_->to_embree(ray);
  QueryContext context = implementation_->context(ray);
  rtcOccluded1(implementation_->all, &context.base, &query.ray);
  return query.ray.tfar < 0.0F;
}

bool RayCaster::occluded(const Vec3& a, const Vec3& b) const {
  const Vec3 d = b - a;
  const double length = d.norm();
  return occluded({a, d / length, length - skip_distance()});
}

bool RayCaster::inside(const Vec3& p, std::uint32_t object) const {
  const EmbreeShape& shape = implementation_->embree_shapes[object];
  if (shape.sphere != nullptr)
    return (p - shape.sphere->center).squaredNorm() < shape.sphere->radius * shape.sphere->radius;
  const Bounds& box = implementation_->boxes[object];
  if ((p.array() < box.lo.array()).any() || (p.array() > box.hi.array()).any()) return false;
  // Two rays, and a third if a grazed edge makes them disagree.
  const bool first = implementation_->winding(p, object, probe_directions[0]) > 0;
  const bool second = implementation_->winding(p, object, probe_directions[1]) > 0;
  if (first == second) return first;
  return implementation_->winding(p, object, probe_directions[2]) > 0;
}

std::optional<NearestPoint> RayCaster::nearest_point(const Vec3& p, std::uint32_t object,
                                                     double max_distance) const {
  const EmbreeShape& shape = implementation_->embree_shapes[object];
  if (shape.sphere != nullptr) {
    const Vec3 from_center = p - shape.sphere->center;
    const double r = from_center.norm();
    const double distance = std::abs(r - shape.sphere->radius);
    if (distance > max_distance) return std::nullopt;
    const Vec3 n = r > 0.0 ? Vec3(from_center / r) : Vec3(Vec3::UnitZ());
    return NearestPoint{{shape.sphere->center + shape.sphere->radius * n, n}, 0, distance};
  }
  NearestQuery nearest{&shape, p, max_distance * max_distance, Vec3::Zero(),
                       RTC_INVALID_GEOMETRY_ID};
  const Vec3 q = (p - shape.center) * shape.scale;
  RTCPointQuery query{};
  query.x = static_cast<float>(q.x());
  query.y = static_cast<float>(q.y());
  query.z = static_cast<float>(q.z());
  query.radius = query_radius(max_distance * shape.scale);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(implementation_->single[object], &query, &context, nearest_callback, &nearest);
  if (nearest.primitive == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return NearestPoint{{nearest.position, shape.mesh->normal(nearest.primitive)},
                      nearest.primitive,
                      std::sqrt(nearest.square)};
}

std::vector<RayCaster::Crossing> RayCaster::crossings(const Ray& ray, std::uint32_t object) const {
  const std::vector<Crossing> all = implementation_->all_crossings(ray, object);
  // Beyond the last crossing the ray is outside; counting back from there gives the depth at its
  // start without an inside test.
  int depth = 0;
  for (const Crossing& crossing : all) depth += crossing.leaving ? 1 : -1;
  std::vector<Crossing> merged;
  for (const Crossing& crossing : all) {
    const int next = depth + (crossing.leaving ? -1 : 1);
    if ((depth > 0) != (next > 0) && crossing.t < ray.t_max) merged.push_back(crossing);
    depth = next;
  }
  return merged;
}

double RayCaster::path_length_inside(const Ray& ray, std::uint32_t object) const {
  const std::vector<Crossing> found = crossings({ray.origin, ray.direction}, object);
  double length = 0.0;
  double entered = 0.0;  // inside from the start, if the first crossing leaves
  for (const Crossing& crossing : found) {
    if (crossing.leaving)
      length += std::max(0.0, std::min(crossing.t, ray.t_max) - entered);
    else
      entered = std::min(crossing.t, ray.t_max);
  }
  return length;
}

}  // namespace knotlight
