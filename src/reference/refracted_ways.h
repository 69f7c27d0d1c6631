// The ways that light takes from outside to a point inside a refracting object: straight to the
// surface, refracted there once, straight on; in a box also mirrored on the way. What next-event
// estimation needs where straight lines do not lead to a light.
//
// A sphere: the way lies in the plane of light, point and centre, in which all solutions are found.
// A mesh: its flat facets are the true surface. The plane of each has one point where light is
// refracted towards the point, which counts if it lies in the facet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/rng.h"
#include "core/shape.h"
#include "core/vec3.h"

namespace knotlight {

// A source of light outside: a place, or a direction at infinity.
struct LightPlace {
  Vec3 place;  // position; at infinity: unit vector towards it
  bool at_infinity = false;
};

// Of the light of a lamp over a dense box about 7 % is mirrored inside once before it is scattered,
// 0.2 % twice; a box of one mean free path leaves 0.2 % to a third time.
constexpr int most_mirrors = 2;

struct RefractedWay {
  Vec3 start;           // unit, from the inner point on: to the first mirror, if any
  Vec3 crossing;        // on the surface
  Vec3 inside;          // unit, from the inner point or the last mirror to the crossing
  Vec3 outside;         // unit, from the crossing towards the light
  double length;        // inside
  double outer_length;  // from the crossing to the light; infinite if it is at infinity
  double transmitted;   // 1 - Fresnel reflectance
  // Without that: irradiance across the way at the inner point, per intensity of a light at a place
  // (1/length^2) or per irradiance across the beam of one at infinity (1).
  double gain;
  int mirrors = 0;
  std::array<Vec3, most_mirrors> mirror_normals = {};  // outward, in the order met
};

// What refraction makes of a pencil of light that comes from a point at distance `outer_length`
// (infinite: a parallel beam) and goes on for `length` inside: RefractedWay::gain. With the
// curvatures of the wave front behind the surface along and across the plane of incidence,
//   ior cos_t^2 k_m = cos_i^2 / outer_length - B,   ior k_s = 1 / outer_length - B,
//   B = curvature (ior cos_t - cos_i)                                          [BW99 ch. 4.6]
// an area of the front grows by (1 + k_m length) (1 + k_s length) from the surface on, where it is
// cos_t / cos_i times what came in. curvature: 1/radius of a sphere, 0 of a plane; cos_i outside,
// cos_t inside.
double refracted_gain(double outer_length, double length, double cos_i, double cos_t, double ior,
                      double curvature);

// How far the light is above the plane through `a`; at infinity the cosine of its direction.
double height_over_plane(const Vec3& a, const Vec3& normal, const LightPlace& light);

class RefractingSurface {
 public:
  // `shape` must outlive this; ior over that of the outside, > 1.
  RefractingSurface(const Shape& shape, double ior);

  // Appends the ways from the light to the point p inside that no mirror lies on. Whether the
  // surface is there at the crossing, and nothing else in the way, the caller has to find out: of a
  // shape with few planes (a box) the crossings within the bounds of a plane's facets are given.
  void find(const Vec3& p, const LightPlace& light, std::vector<RefractedWay>& ways) const;

  // Appends ways that are mirrored 1 to most_mirrors times inside a shape with few planes; none for
  // other shapes. Whether its mirrors are met in this order the caller has to find out too. Each is
  // played for: it is found with a probability of e^(-sigma_t l), l < length, times the Fresnel
  // reflectances of its mirrors. Its gain is divided by the first, and the reflectances are left
  // out, so that expected sums are right for any sigma_t (1/length), and that none weighs more than
  // its attenuation by a medium of extinction sigma_t or more makes up for.
  void find_mirrored(const Vec3& p, const LightPlace& light, double sigma_t, Rng& rng,
                     std::vector<RefractedWay>& ways) const;
  bool finds_mirrored() const { return !planes_.empty(); }

  // Whether find() costs about as much as a ray (spheres, few planes), not as much as tens.
  bool quick() const { return nodes_.empty(); }

  double curvature() const { return sphere_ != nullptr ? 1.0 / sphere_->radius : 0.0; }

 private:
  struct Facet {
    Vec3 a, b, c, normal;
    Vec3 dual_b, dual_c;  // (p - a) . dual_b is the barycentric coordinate that is 1 at b
  };
  struct Plane {
    Facet facet;    // one of those in it
    Bounds bounds;  // of them all, and rounding
  };
  // Facets first..last-1 lie in a ball, their normals in a cone.
  struct Node {
    Vec3 center, axis;
    double radius, cos_cone, sin_cone;
    std::uint32_t first, last;
    std::uint32_t skip;  // the node after this one's descendants
  };

  void find_on_sphere(const Vec3& p, const LightPlace& light,
                      std::vector<RefractedWay>& ways) const;
  void find_on_facet(const Facet& facet, const Vec3& p, const LightPlace& light,
                     std::vector<RefractedWay>& ways) const;
  void find_on_plane(const Plane& plane, const Vec3& p, const LightPlace& light,
                     std::vector<RefractedWay>& ways) const;
  struct MirrorSearch;
  void mirror(const Vec3& image, int mirrors, double least, MirrorSearch& search) const;
  void group_planes(double touching);
  bool may_refract(const Node& node, const Vec3& p, const LightPlace& light) const;
  void build(std::uint32_t first, std::uint32_t last, double normal_scale);

  const Sphere* sphere_;
  double ior_;
  std::vector<Facet> facets_;
  std::vector<Plane> planes_;  // if there are few; else the tree is used
  std::vector<Node> nodes_;    // depth first
};

}  // namespace knotlight
