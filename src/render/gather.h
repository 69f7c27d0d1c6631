// The radiance inside a translucent object, where the eye looks into it: what the medium sends
// along the (refracted) view ray, collected over its whole length.
//
//   L(x, -w) = int_0^S exp(-sigma_t s) J(x + s w) ds + exp(-sigma_t S) L_behind
//
//   J = sigma_s U_d                  scattered before: the diffusion solution, taken as isotropic
//     + sigma_s int p L_ri dw'       scattered once: straight from the lights
//     + E / (4 pi)                   emitted
//
// Beyond P1 (core/asymptotic.h) U_d is the sum of the solution, which is then the asymptotic part,
// times the layer weight of the depth, and of the transient part: light on the way from its first
// scattering to its second,
//
//   int epsilon(sigma_t r) exp(-sigma_t r) (sigma_s U_ri + E / 4 pi)(x + r w') dr dw' / (4 pi).
//
// With g != 0 light that is scattered more than once is seen in the similar medium, ((1 - g)
// sigma_s, 0), and what that gets wrong below a lit surface is put right as for a half-space.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/asymptotic.h"
#include "core/half_space.h"
#include "core/rng.h"
#include "core/surface_layer.h"
#include "grid/solver.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

inline constexpr double invisible = 1e-5;  // share of light that need not be followed further

// One object's solution, where it can be looked up anywhere inside.
struct InsideField {
  struct Channel {
    GridField U_d;  // W/(length^2 sr)
    std::optional<PointSourceField> beyond_p1;
    double k = 0.0;  // extrapolation length that U_d was solved with
    Medium medium;   // in which light that is scattered more than once is seen
    // Of a refracting object, where no straight line leads to the lights: by the photons.
    std::optional<GridField> U_ri;
  };
  std::vector<Channel> channels;
  std::optional<FeltSurface> surface;  // where some channel goes beyond P1
  // U_d, also that on the surface, holds U_ri too, of light which is diffuse from the moment it
  // enters (the source model boundary_flux): nothing is to be added from the lights, and entered /
  // (2 pi) has to come off for the flux that leaves.
  bool counts_entering_light = false;
};

// How a ray that leaves the object is to be followed.
struct OutsideRay {
  Ray ray;
  int bounces;  // surfaces of other objects it may still pass or be mirrored by
  // Whether the eye follows it, and sees all; or light is looked for where it leads, then the
  // lights that are sampled one by one do not count, and objects glow as their surface does.
  bool seen;
  // Whether it comes out of an object here: what touches the surface outside is met at once.
  bool leaving;
};
using OutsideRadiance = std::function<Spectrum(const OutsideRay& ray, Rng& rng)>;

// Radiance inside an object, W/(length^2 sr), by what it went through there.
struct GatheredRadiance {
  Spectrum once = Spectrum::Zero();    // scattered once
  Spectrum more = Spectrum::Zero();    // scattered more than once, or emitted
  Spectrum behind = Spectrum::Zero();  // shines through

  // The half-spaces' difference in `more` may take off more than is there at dark rims.
  Spectrum sum() const { return (once + more + behind).max(0.0); }
};

class Gather {
 public:
  // All must outlive it; caster was built from scene.objects in order. outside: what a ray meets
  // that leaves the object.
  Gather(const Scene& scene, const RayCaster& caster, std::uint32_t object,
         const InsideField& field, OutsideRadiance outside);

  // One Monte Carlo estimate of the radiance that arrives at `hit` on the surface along the view
  // ray, which goes on into the object. depth_sample in [0, 1) places the samples along the ray:
  // spread it evenly over the rays of one pixel.
  GatheredRadiance radiance(const Ray& ray, const Hit& hit, int bounces, double depth_sample,
                            Rng& rng) const;

  // Beyond P1, U_d on the surface is the solution times this weight plus the mean of these
  // estimates, W/(length^2 sr). Not for channels with P1.
  double surface_weight(int channel, const Hit& hit) const {
    const double bend = curvature(hit);
    return layer(channel, {{hit.position, -hit.normal}, 1.0, 1.0, 1.0, bend, bend}, 0.0);
  }
  Spectrum transient(const Vec3& position, Rng& rng) const;

 private:
  // A straight part of a view ray within the object.
  struct Segment {
    Ray ray;
    double length;
    double cosine_begin, cosine_end;        // with the surface's normals there
    double curvature_begin, curvature_end;  // over the surface's median, 1/length
  };
  // A medium in all channels.
  struct Optics {
    std::vector<Medium> media;  // three
    Spectrum sigma_s, sigma_t;
    explicit Optics(std::vector<Medium> m);
  };
  Spectrum diffuse(const Segment& segment, double depth_sample) const;
  double mean_U_d(int channel, const Segment& segment, double depth_sample) const;
  template <class Light>
  Spectrum sampled(const Segment& segment, const Optics& optics, double depth_sample, Rng& rng,
                   const Light& light) const;
  Spectrum scattered_once(const Vec3& position, const Vec3& view, const Optics& optics,
                          Rng& rng) const;
  Spectrum reflected_beyond_similar(const Ray& ray, const Hit& hit, Rng& rng) const;
  Spectrum more_than_similar(double cosine, const Vec3& view, const Vec3& to_light,
                             const Vec3& normal) const;
  Spectrum lights(const Vec3& position, const Vec3& view, const Optics& optics, Rng& rng) const;
  Spectrum surroundings(const Vec3& position, const Vec3& view, const Optics& optics,
                        Rng& rng) const;
  double layer(int channel, const Segment& segment, double s) const;
  double curvature(const Hit& hit) const;
  std::optional<Hit> way_out(const Ray& ray) const;
  int draw_channel(Rng& rng) const;

  const Scene& scene_;
  const RayCaster& caster_;
  std::uint32_t object_;
  const TranslucentMaterial& material_;
  const InsideField& field_;
  OutsideRadiance outside_;
  Optics once_;      // the object's medium
  Optics multiply_;  // that of light scattered more than once
  // Of half-spaces of both media, per channel; none if they are the same.
  struct Reflections {
    HalfSpaceReflection own, similar;
  };
  std::vector<Reflections> reflections_;
  bool dark_surroundings_;  // nothing but single lights can be met outside
  bool transient_;          // some channel goes beyond P1
};

}  // namespace knotlight
