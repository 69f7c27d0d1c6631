#include "reference/refracted_ways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/fresnel.h"
#include "core/not_finite.h"

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr std::uint32_t facets_per_leaf = 4;
constexpr std::size_t most_planes = 16;  // tried one by one, a tree of facets costs about as much
constexpr double same_plane = 1e-9;      // far above rounding, far below any modelled angle
constexpr double rounding = 1e-12;       // far above that of the cones' cosines
// Newton steps towards a root that bisection safeguards: enough for bisection alone to come below
// the rounding of double precision.
constexpr int most_steps = 60;
constexpr double angle_rounding = 1e-15;  // radians
// A pair of roots nearer to each other than 2^-24 of an interval may be missed.
constexpr int turn_steps = 24;
// Intervals in which the sphere's equation is searched for roots and for extrema between roots. It
// is a low harmonic of the angle but near the point, where a node of its own stands: twice as many
// find the same roots (tests/reference/refracted_ways_test.cpp).
constexpr int sphere_intervals = 16;

// A value and its derivative.
struct Slope {
  double f, slope;
};

// The one root of f between lo and hi, at which its signs differ: Newton's steps, halves where they
// leave the bracket or do not shorten it.
template <typename F>
double root_between(const F& f, double lo, double hi, double f_lo) {
  double x = 0.5 * (lo + hi);
  double last_step = hi - lo;
  for (int i = 0; i < most_steps; ++i) {
    const Slope here = f(x);
    ((here.f < 0.0) == (f_lo < 0.0) ? lo : hi) = x;
    double next = x - here.f / here.slope;
    if (!(next > lo && next < hi) || 2.0 * std::abs(next - x) > last_step) next = 0.5 * (lo + hi);
    last_step = std::abs(next - x);
    if (last_step <= angle_rounding) return next;
    x = next;
  }
  return x;
}

// Where f, which rises on one end and falls on the other, turns: halves, to the digits that matter
// for the sign it has there.
template <typename F>
double turn_between(const F& f, double lo, double hi, double slope_lo) {
  for (int i = 0; i < turn_steps; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((f(middle).slope < 0.0) == (slope_lo < 0.0) ? lo : hi) = middle;
  }
  return 0.5 * (lo + hi);
}

// Distance, along the plane from below the light, at which light of height h above a plane is
// refracted to a point of depth d below it, at distance D along the plane: Snell's law
// ior sin(t) = sin(i) increases with the distance x from above the point to the crossing.
double crossing_of_plane(double d, double h, double D, double ior) {
  double lo = 0.0;
  double hi = D;
  // Small angles, exact for them: x / d * ior = (D - x) / h.
  double x = D * d / (d + ior * h);
  for (int i = 0; i < most_steps; ++i) {
    const double in = std::hypot(d, x);
    const double out = std::hypot(h, D - x);
    const double f = ior * x / in - (D - x) / out;
    if (f > 0.0)
      hi = x;
    else
      lo = x;
    const double slope = ior * d * d / (in * in * in) + h * h / (out * out * out);
    double next = x - f / slope;
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - x) <= 1e-15 * D) return next;
    x = next;
  }
  return x;
}

// Where light is refracted towards p at the plane through `a`; nothing unless p lies below it and
// the light above.
std::optional<Vec3> crossing_of(const Vec3& a, const Vec3& normal, const Vec3& p,
                                const LightPlace& light, double ior) {
  const double depth = (a - p).dot(normal);
  const double height = height_over_plane(a, normal, light);
  if (depth <= 0.0 || height <= 0.0) return std::nullopt;
  const Vec3 above = p + depth * normal;
  if (light.at_infinity) {
    const Vec3 sine = (light.place - height * normal) / ior;
    return above + depth / std::sqrt(1.0 - sine.squaredNorm()) * sine;
  }
  const Vec3 along = light.place - height * normal - above;
  const double D = along.norm();
  if (!(D > 0.0)) return above;
  return above + crossing_of_plane(depth, height, D, ior) / D * along;
}

double angle_between(const Vec3& unit_a, const Vec3& unit_b) {
  return 2.0 * std::asin(std::min(1.0, 0.5 * (unit_a - unit_b).norm()));
}

// How far a unit vector can be from the axis of a cone that a ball is seen in: sine of the half
// angle given, chord of the half angle returned.
double chord_of_cone(double sine) {
  return std::sqrt(2.0 - 2.0 * std::sqrt(std::max(0.0, 1.0 - sine * sine)));
}

void add_way(const Vec3& p, const Vec3& crossing, const Vec3& normal, const LightPlace& light,
             double ior, double curvature, std::vector<RefractedWay>& ways) {
  const Vec3 in = crossing - p;
  const Vec3 out = light.at_infinity ? light.place : Vec3(light.place - crossing);
  const Vec3 inside = in.normalized();
  RefractedWay way{inside, crossing, inside, out.normalized(), in.norm(), infinity, 0.0, 0.0};
  if (!light.at_infinity) way.outer_length = out.norm();
  const double cos_i = way.outside.dot(normal);
  const double cos_t = way.inside.dot(normal);
  if (!(cos_i > 0.0 && cos_t > 0.0)) return;
  way.transmitted = 1.0 - fresnel_reflectance(cos_i, ior);
  way.gain = refracted_gain(way.outer_length, way.length, cos_i, cos_t, ior, curvature);
  ways.push_back(way);
}

}  // namespace

double refracted_gain(double outer_length, double length, double cos_i, double cos_t, double ior,
                      double curvature) {
  const bool beam = std::isinf(outer_length);
  const double arriving = beam ? 0.0 : 1.0 / outer_length;
  const double bend = curvature * (ior * cos_t - cos_i);
  const double meridional = (cos_i * cos_i * arriving - bend) / (ior * cos_t * cos_t);
  const double sagittal = (arriving - bend) / ior;
  const double spread =
      cos_t / cos_i * std::abs((1.0 + meridional * length) * (1.0 + sagittal * length));
  return beam ? 1.0 / spread : 1.0 / (outer_length * outer_length * spread);
}

double height_over_plane(const Vec3& a, const Vec3& normal, const LightPlace& light) {
  return light.at_infinity ? light.place.dot(normal) : (light.place - a).dot(normal);
}

RefractingSurface::RefractingSurface(const Shape& shape, double ior)
    : sphere_(std::get_if<Sphere>(&shape)), ior_(ior) {
  if (sphere_ != nullptr) return;
  const auto& mesh = std::get<TriangleMesh>(shape);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3& a = mesh.corner(i, 0);
    const Vec3& b = mesh.corner(i, 1);
    const Vec3& c = mesh.corner(i, 2);
    const Vec3 n = (b - a).cross(c - a);
    if (!(n.squaredNorm() > 0.0)) continue;  // no area, no light
    facets_.push_back({a, b, c, n.normalized(), (c - a).cross(n) / n.squaredNorm(),
                       n.cross(b - a) / n.squaredNorm()});
  }
  if (facets_.empty()) return;
  group_planes(same_plane * bounds(shape).radius());
  if (planes_.empty()) build(0, static_cast<std::uint32_t>(facets_.size()), bounds(shape).radius());
}

void RefractingSurface::group_planes(double touching) {
  for (const Facet& facet : facets_) {
    auto known = std::find_if(planes_.begin(), planes_.end(), [&](const Plane& plane) {
      return (facet.normal - plane.facet.normal).norm() <= same_plane &&
             std::abs((facet.a - plane.facet.a).dot(plane.facet.normal)) <= touching;
    });
    if (known == planes_.end()) {
      if (planes_.size() == most_planes) {
        planes_.clear();
        return;
      }
      known = planes_.insert(planes_.end(), {facet, {}});
    }
    for (const Vec3* corner : {&facet.a, &facet.b, &facet.c}) {
      known->bounds.extend(*corner - Vec3::Constant(touching));
      known->bounds.extend(*corner + Vec3::Constant(touching));
    }
  }
}

// Halves in the middle of the longest of six extents, those of the centroids and those of the
// normals times `normal_scale`: a ball over the edge between two faces could never be ruled out.
void RefractingSurface::build(std::uint32_t first, std::uint32_t last, double normal_scale) {
  using Place = Eigen::Array<double, 6, 1>;
  const auto place = [normal_scale](const Facet& f) -> Place {
    Place x;
    x << ((f.a + f.b + f.c) / 3.0).array(), normal_scale * f.normal.array();
    return x;
  };
  Bounds box;
  Place lo = place(facets_[first]);
  Place hi = lo;
  Vec3 mean_normal = Vec3::Zero();
  for (std::uint32_t i = first; i < last; ++i) {
    for (const Vec3* corner : {&facets_[i].a, &facets_[i].b, &facets_[i].c}) box.extend(*corner);
    lo = lo.min(place(facets_[i]));
    hi = hi.max(place(facets_[i]));
    mean_normal += facets_[i].normal;
  }
  Node node{box.center(), Vec3::UnitZ(), 0.0, -1.0, 0.0, first, last, 0};
  for (std::uint32_t i = first; i < last; ++i)
    for (const Vec3* corner : {&facets_[i].a, &facets_[i].b, &facets_[i].c})
      node.radius = std::max(node.radius, (*corner - node.center).norm());
  if (mean_normal.norm() > 0.0) {
    node.axis = mean_normal.normalized();
    double cone = 0.0;
    for (std::uint32_t i = first; i < last; ++i)
      cone = std::max(cone, angle_between(node.axis, facets_[i].normal));
    node.cos_cone = std::cos(cone);
    node.sin_cone = std::sin(cone);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back(node);
  if (last - first > facets_per_leaf) {
    Eigen::Index axis = 0;
    (hi - lo).maxCoeff(&axis);
    const double half = 0.5 * (lo[axis] + hi[axis]);
    const auto split =
        std::partition(facets_.begin() + first, facets_.begin() + last,
                       [&](const Facet& facet) { return place(facet)[axis] < half; });
    auto middle = static_cast<std::uint32_t>(split - facets_.begin());
    if (middle == first || middle == last) middle = first + (last - first) / 2;
    build(first, middle, normal_scale);
    build(middle, last, normal_scale);
  }
  nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
}

void RefractingSurface::find(const Vec3& p, const LightPlace& light,
                             std::vector<RefractedWay>& ways) const {
  if (sphere_ != nullptr) {
    find_on_sphere(p, light, ways);
    return;
  }
  for (const Plane& plane : planes_) find_on_plane(plane, p, light, ways);
  for (std::uint32_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    if (!may_refract(node, p, light)) {
      i = node.skip;
      continue;
    }
    if (node.last - node.first <= facets_per_leaf)
      for (std::uint32_t k = node.first; k < node.last; ++k)
        find_on_facet(facets_[k], p, light, ways);
    i += 1;
  }
}

// Where Snell's law holds, the outward normal is along -(ior u + w), u and w the unit vectors from
// the surface to the point inside and to the light [W09]. Over the node's ball u and w each stay
// within a cone, so their sum stays within a ball around its value at the centre, and the normal
// within a cone that has to meet that of the node's normals.
bool RefractingSurface::may_refract(const Node& node, const Vec3& p,
                                    const LightPlace& light) const {
  const Vec3 to_p = p - node.center;
  const double distance_p = to_p.norm();
  if (distance_p <= node.radius) return true;
  double reach = ior_ * chord_of_cone(node.radius / distance_p);
  Vec3 w = light.place;
  if (!light.at_infinity) {
    const Vec3 to_light = light.place - node.center;
    const double distance = to_light.norm();
    if (distance <= node.radius) return true;
    reach += chord_of_cone(node.radius / distance);
    w = to_light / distance;
  }
  const Vec3 sum = -(ior_ * to_p / distance_p + w);
  const double length = sum.norm();
  if (length <= reach) return true;
  // Cosine and sine of the angle between `sum` and the cone's axis at which the two cones touch.
  const double sine = reach / length;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double touching_sine = sine * node.cos_cone + cosine * node.sin_cone;
  const double touching_cosine = cosine * node.cos_cone - sine * node.sin_cone;
  return touching_sine < 0.0 || sum.dot(node.axis) >= length * (touching_cosine - rounding);
}

void RefractingSurface::find_on_facet(const Facet& facet, const Vec3& p, const LightPlace& light,
                                      std::vector<RefractedWay>& ways) const {
  const auto crossing = crossing_of(facet.a, facet.normal, p, light, ior_);
  if (!crossing) return;
  const Vec3 from_a = *crossing - facet.a;
  const double at_b = from_a.dot(facet.dual_b);
  const double at_c = from_a.dot(facet.dual_c);
  if (at_b < 0.0 || at_c < 0.0 || at_b + at_c > 1.0) return;
  add_way(p, *crossing, facet.normal, light, ior_, 0.0, ways);
}

void RefractingSurface::find_on_plane(const Plane& plane, const Vec3& p, const LightPlace& light,
                                      std::vector<RefractedWay>& ways) const {
  const auto crossing = crossing_of(plane.facet.a, plane.facet.normal, p, light, ior_);
  if (!crossing || (crossing->array() < plane.bounds.lo.array()).any() ||
      (crossing->array() > plane.bounds.hi.array()).any())
    return;
  add_way(p, *crossing, plane.facet.normal, light, ior_, 0.0, ways);
}

// In the plane of centre, light (on the first axis) and point: f is the part along the surface of
// ior u + w, u and w as above, at the angle phi from the light. Snell's law is f = 0.
void RefractingSurface::find_on_sphere(const Vec3& p, const LightPlace& light,
                                       std::vector<RefractedWay>& ways) const {
  const double R = sphere_->radius;
  const Vec3 to_light = light.at_infinity ? light.place : Vec3(light.place - sphere_->center);
  const double light_distance = to_light.norm();
  if (!light.at_infinity && light_distance <= R) return;
  const Vec3 axis = to_light / light_distance;
  const Vec3 from_center = p - sphere_->center;
  const double px = from_center.dot(axis);
  const Vec3 off_axis = from_center - px * axis;
  const double py = off_axis.norm();
  const Vec3 side = py > 0.0 ? Vec3(off_axis / py) : Frame(axis).t;

  const auto evaluate = [&](double phi) -> Slope {
    const double nx = std::cos(phi);
    const double ny = std::sin(phi);
    const double ux = px - R * nx;
    const double uy = py - R * ny;
    const double u_length = std::sqrt(ux * ux + uy * uy);
    const double u_along = (-ny * ux + nx * uy) / u_length;
    const double u_normal = (nx * ux + ny * uy) / u_length;
    double w_along = -ny;
    double w_normal = nx;
    double w_turn = 0.0;
    if (!light.at_infinity) {
      const double w_length =
          std::sqrt(light_distance * light_distance + R * R - 2.0 * light_distance * R * nx);
      w_along = -ny * light_distance / w_length;
      w_normal = (nx * light_distance - R) / w_length;
      w_turn = R * (1.0 - w_along * w_along) / w_length;
    }
    const double u_turn = R * (1.0 - u_along * u_along) / u_length;
    return {ior_ * u_along + w_along, -ior_ * (u_normal + u_turn) - w_normal - w_turn};
  };

  // The lit cap. f is steep where the surface is near to the point or to the light: nodes there.
  const double end = light.at_infinity ? 0.5 * pi : std::acos(R / light_distance);
  std::array<double, sphere_intervals + 2> nodes{};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    nodes[i] = end * (2.0 * static_cast<double>(i) / sphere_intervals - 1.0);
  nodes.back() = std::clamp(std::atan2(py, px), -end, end);
  std::sort(nodes.begin(), nodes.end());

  const auto add = [&](double phi) {
    const Vec3 normal = std::cos(phi) * axis + std::sin(phi) * side;
    add_way(p, sphere_->center + R * normal, normal, light, ior_, 1.0 / R, ways);
  };
  const auto search = [&](double lo, double hi, double f_lo, double f_hi) {
    if (lo < hi && (f_lo < 0.0) != (f_hi < 0.0)) add(root_between(evaluate, lo, hi, f_lo));
  };
  Slope before = evaluate(nodes[0]);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i] == nodes[i - 1]) continue;
    const Slope here = evaluate(nodes[i]);
    if ((before.slope < 0.0) != (here.slope < 0.0) && (before.f < 0.0) == (here.f < 0.0)) {
      const double turn = turn_between(evaluate, nodes[i - 1], nodes[i], before.slope);
      const double f_turn = evaluate(turn).f;
      search(nodes[i - 1], turn, before.f, f_turn);
      search(turn, nodes[i], f_turn, here.f);
    } else {
      search(nodes[i - 1], nodes[i], before.f, here.f);
    }
    before = here;
  }
}

}  // namespace knotlight
