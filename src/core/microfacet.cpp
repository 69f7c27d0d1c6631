#include "core/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/fresnel.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// A walk ends at each facet with a probability of about a third or more: after so many, rounding
// has caught the light in the surface's plane.
constexpr int most_facets = 1000;

// The normal on the side that the light comes from.
Vec3 facing(const Vec3& n, const Vec3& d) {
  return d.dot(n) < 0.0 ? n : Vec3(-n);
}

// Facets in the way of a direction at this cosine (of its size) to the normal, on the mean
// [H14 eq. 72]; Smith's masking is 1 / (1 + it).
double obstacles(double cosine, double alpha) {
  const double c2 = cosine * cosine;
  return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - c2) / c2) - 1.0);
}

// Share of what a facet sends on that meets no other, given that light got there.
double unshadowed(double cosine_in, double cosine_out, bool transmitted, double alpha) {
  const double in = obstacles(cosine_in, alpha);
  const double out = obstacles(cosine_out, alpha);
  return (1.0 + in) * (transmitted ? std::beta(1.0 + in, 1.0 + out) : 1.0 / (1.0 + in + out));
}

// Density of facet normals, times their cosine per area [WMLT07 eq. 33].
double distribution(double cosine, double alpha) {
  const double a2 = alpha * alpha;
  // 1 - c^2 + a^2 c^2 without loss of digits near c = 1
  const double s = (1.0 - cosine) * (1.0 + cosine) + a2 * cosine * cosine;
  return a2 / (pi * s * s);
}

// A facet normal among those visible from `to_eye` (local, z up), which may lie below the horizon;
// density D(m) (to_eye . m) over the facets' projected area, per solid angle [H18 listing 1].
Vec3 sample_visible_normal(const Vec3& to_eye, double alpha, double u, double v) {
  // The ellipsoid whose normals are the facets' is stretched to a hemisphere, whose projection
  // along the view is a disc cut by an ellipse.
  const Vec3 stretched = Vec3(alpha * to_eye.x(), alpha * to_eye.y(), to_eye.z()).normalized();
  const Frame frame(stretched);
  Vec3 across = Vec3(-stretched.y(), stretched.x(), 0.0);
  across = across.squaredNorm() > 0.0 ? across.normalized() : frame.t;
  const Vec3 upwards = stretched.cross(across);
  const double r = std::sqrt(u);
  const double x = r * std::cos(2.0 * pi * v);
  const double s = 0.5 * (1.0 + stretched.z());
  const double y = (1.0 - s) * std::sqrt(1.0 - x * x) + s * r * std::sin(2.0 * pi * v);
  const double z = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
  const Vec3 on_hemisphere = x * across + y * upwards + z * stretched;
  return Vec3(alpha * on_hemisphere.x(), alpha * on_hemisphere.y(),
              std::max(0.0, on_hemisphere.z()))
      .normalized();
}

// Where light next meets a facet, as the share of the surface that lies lower: it goes at this
// cosine to the normal from where the share is `lower`. Nothing if it leaves [H16 algorithm 1].
std::optional<double> next_height(double cosine, double lower, double alpha, double u) {
  const double ahead = obstacles(cosine, alpha);
  if (cosine <= 0.0) return lower * std::pow(1.0 - u, 1.0 / (1.0 + ahead));
  if (u >= 1.0 - std::pow(lower, ahead)) return std::nullopt;
  return std::min(1.0, lower / std::pow(1.0 - u, 1.0 / ahead));
}

// The facet that turns d into `out`.
struct Facet {
  Vec3 normal;  // on the side of the arriving light
  bool transmits;
  double solid_angle;  // of facet normals per solid angle of `out` [WMLT07 eq. 14, 17]
  bool exists;
};
Facet facet_between(const Vec3& d, const Vec3& out, const Vec3& n, double eta) {
  Facet facet{Vec3::Zero(), out.dot(n) < 0.0, 0.0, false};
  facet.normal = facet.transmits ? Vec3(d - eta * out) : Vec3(out - d);
  const double length = facet.normal.norm();
  if (length == 0.0) return facet;
  facet.normal = facing(facet.normal / length, d);
  const double cos_in = -d.dot(facet.normal);
  const double cos_out = out.dot(facet.normal);
  // On the facet's own sides, too, or light would pass through it backwards.
  facet.exists = facet.normal.dot(n) > 0.0 && cos_in > 0.0 && (cos_out < 0.0) == facet.transmits;
  if (!facet.exists) return facet;
  const double leg = cos_in + eta * cos_out;
  facet.solid_angle = facet.transmits ? eta * eta * -cos_out / (leg * leg) : 1.0 / (4.0 * cos_in);
  return facet;
}

}  // namespace

FacetEvent sample_facet(const Vec3& d, const Vec3& n, double eta, double alpha, double u, double v,
                        double w) {
  const Frame frame(facing(n, d));
  const Vec3 to_eye(-d.dot(frame.t), -d.dot(frame.b), -d.dot(frame.n));
  const Vec3 m = frame.to_world(sample_visible_normal(to_eye, alpha, u, v));
  const auto refracted = refract(d, m, eta);
  FacetEvent event{Vec3::Zero(), false, 0.0};
  event.transmitted = refracted && w >= fresnel_reflectance(std::min(1.0, std::abs(d.dot(m))), eta);
  event.direction = event.transmitted ? *refracted : reflect(d, m);
  const double cosine = event.direction.dot(frame.n);
  if ((cosine < 0.0) == event.transmitted && cosine != 0.0 && to_eye.z() > 0.0)
    event.weight = unshadowed(to_eye.z(), cosine, event.transmitted, alpha);
  return event;
}

double facet_pdf(const Vec3& d, const Vec3& out, const Vec3& n, double eta, double alpha) {
  const Vec3 up = facing(n, d);
  const double cosine = -d.dot(up);
  const Facet facet = facet_between(d, out, up, eta);
  if (cosine == 0.0 || !facet.exists) return 0.0;
  const double cos_in = -d.dot(facet.normal);
  const double R = fresnel_reflectance(cos_in, eta);
  return (facet.transmits ? 1.0 - R : R) / (1.0 + obstacles(cosine, alpha)) *
         distribution(facet.normal.dot(up), alpha) * cos_in / cosine * facet.solid_angle;
}

double facet_power(const Vec3& d, const Vec3& out, const Vec3& n, double eta, double alpha) {
  const double density = facet_pdf(d, out, n, eta, alpha);
  if (density == 0.0) return 0.0;
  return density * unshadowed(d.dot(n), out.dot(n), d.dot(n) * out.dot(n) > 0.0, alpha);
}

SurfaceEvent cross_rough_surface(const Vec3& d, const Vec3& n, double eta, double alpha, Rng& rng) {
  const Frame frame(facing(n, d));
  Vec3 w(d.dot(frame.t), d.dot(frame.b), d.dot(frame.n));
  double lower = 1.0;  // share of the surface below the light; heights count from the light's side
  bool below = false;  // on the far side of the facets
  for (int facets = 0; facets < most_facets; ++facets) {
    const auto met = next_height(below ? -w.z() : w.z(), lower, alpha, rng.uniform());
    if (!met) return {frame.to_world(w), below, facets};
    lower = *met;
    const double u = rng.uniform();
    const double v = rng.uniform();
    const Vec3 m = below ? Vec3(-sample_visible_normal(w, alpha, u, v))
                         : sample_visible_normal(-w, alpha, u, v);
    const double across = below ? 1.0 / eta : eta;
    const auto refracted = refract(w, m, across);
    const double R =
        refracted ? fresnel_reflectance(std::min(1.0, std::abs(w.dot(m))), across) : 1.0;
    if (rng.uniform() < R) {
      w = reflect(w, m);
    } else {
      w = *refracted;
      below = !below;
      lower = 1.0 - lower;
    }
  }
  return {reflect(d, n), false, most_facets};
}

}  // namespace knotlight
