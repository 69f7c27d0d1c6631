// Reflection and refraction at a rough dielectric surface: facets too small to see, each a smooth
// dielectric, with normals distributed as GGX has it and Smith's shadowing [WMLT07].
#pragma once

#include "core/rng.h"
#include "core/vec3.h"

namespace knotlight {

// Throughout: d = unit direction of travel of the arriving light, n = unit normal of the surface as
// a whole (either side), eta = index of the far side over that of the near side, not 1 (a surface
// that is not there cannot be seen, however rough), alpha = slope of the facets, above 0; smooth in
// the limit alpha -> 0.

// What becomes of light at one facet.
struct FacetEvent {
  Vec3 direction;    // of travel afterwards, unit
  bool transmitted;  // to the far side of the facet
  double weight;     // 0..1: share of the power that no other facet is in the way of
};

// u, v, w in [0, 1). A facet is drawn among those that d sees [H18], then Fresnel's law is played
// for. The direction has density facet_pdf per solid angle.
FacetEvent sample_facet(const Vec3& d, const Vec3& n, double eta, double alpha, double u, double v,
                        double w);

// Density per solid angle of the directions of sample_facet at `out` (unit, of travel); those with
// weight 0, which end on the wrong side of the surface as a whole, are left out.
double facet_pdf(const Vec3& d, const Vec3& out, const Vec3& n, double eta, double alpha);

// Share of the arriving power that goes on in direction `out` after one facet, per solid angle:
// f_s |out . n| of [WMLT07 eq. 20, 21] with masking and shadowing at one height [H14 eq. 99];
// weight times density. Its integral falls short of 1 by what meets a second facet: little for
// alpha < 0.1, half of it and more for alpha near 1.
double facet_power(const Vec3& d, const Vec3& out, const Vec3& n, double eta, double alpha);

// Light that has left the surface for good, by any number of facets: a walk over Smith's surface
// with heights spread evenly [H16]. Facets absorb nothing, so all the power goes on; and light
// finds its way in and out alike.
struct SurfaceEvent {
  Vec3 direction;
  bool transmitted;
  int facets;  // that it has met
};
SurfaceEvent cross_rough_surface(const Vec3& d, const Vec3& n, double eta, double alpha, Rng& rng);

}  // namespace knotlight
