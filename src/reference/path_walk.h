// The life of a path from the eye, in C colour channels at once.
//
// Channels differ in their coefficients, so one of them (the hero, drawn evenly at the start)
// decides flights and turns, and all are weighed by the mean over the channels of the density with
// which each would have led to the same path: multiple importance sampling with the balance
// heuristic [VG95], [W14]. `density` holds those densities relative to their mean, `weight` the
// path's contribution over the mean.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "reference/path_light_table.h"
#include "reference/path_optics.h"
#include "reference/path_surfaces.h"
#include "reference/path_tracer.h"
#include "reference/refracted_ways.h"

namespace knotlight {

class PathTracer::Walker {
 public:
  virtual ~Walker() = default;
  virtual Spectrum radiance(const Ray& eye, Rng& rng) const = 0;
};

// Where a path is scattered: in a medium, or on a diffuse surface.
template <int C>
struct PathVertex {
  const Optics<C>* medium = nullptr;  // that scatters; null: a diffuse surface does
  Vec3 arriving = Vec3::UnitZ();      // direction of travel before
  Vec3 normal = Vec3::UnitZ();        // of the surface, on the path's side

  // Phase function, or cosine over pi: both the share of light taken from direction w per solid
  // angle, 1/sr, and the density with which each channel samples w.
  Channels<C> value(const Vec3& w) const;
};

// From the last vertex on: straight, if through index-matched surfaces; refracted once on the way
// out of the vertex's medium; or in a way that next-event estimation does not know.
enum class Way { straight, refracted, unconnected };

// Where and how a way was refracted.
struct SurfaceExit {
  Vec3 crossing = Vec3::Zero();
  double length = 0.0;                                          // from the vertex
  double cos_i = 1.0, cos_t = 1.0, ior = 1.0, curvature = 0.0;  // as refracted_gain has them

  // Solid angle at the light per solid angle at the vertex, or, for a light at a distance from the
  // crossing, area across the way there per solid angle at the vertex: n^2 times an area across a
  // way times a solid angle is the same at both ends [PBRT 8.2.3].
  double per_solid_angle(double outer_length) const {
    return ior * ior / refracted_gain(outer_length, length, cos_i, cos_t, ior, curvature);
  }
};

template <int C>
struct Path {
  PathRay ray;
  Channels<C> weight = Channels<C>::Ones();
  Channels<C> density = Channels<C>::Ones();  // mean 1
  int hero = 0;
  double index2 = 1.0;  // n^2 of the medium: radiance over n^2 is what a surface passes on
  bool scattered = false;
  // Since the last vertex: density, per solid angle there, of having come here; and whether
  // next-event estimation could have connected the vertex to here.
  double reach = 0.0;
  Way way = Way::unconnected;
  Vec3 vertex = Vec3::Zero();
  SurfaceExit exit;          // if refracted
  double full_weight = 1.0;  // what roulette compares the weight with
  int splits = 0;
  std::size_t events = 0;

  // The weight of the brightest channel, without the factor n^2 that a medium lends it.
  double strength() const { return weight.maxCoeff() * index2; }
  // Weight and densities after an event, each multiplied by its own factors: densities back to mean
  // 1, the mean put into weight and reach.
  void normalise();
};

template <int C>
class PathWalker final : public PathTracer::Walker {
 public:
  PathWalker(const Scene& scene, const RayCaster& caster);
  Spectrum radiance(const Ray& eye, Rng& rng) const override;

 private:
  // One sample under way: what has been found so far, and the branches still to be followed.
  struct Sample {
    Rng& rng;
    Channels<C> found = Channels<C>::Zero();
    std::array<Path<C>, 16> pending;
    std::size_t waiting = 0;
    std::vector<RefractedWay> ways;  // scratch

    // For the branches of one event.
    bool room() const { return waiting + 2 <= pending.size(); }
  };

  // One event of the path; false when it has ended.
  bool step(Path<C>& path, Sample& sample) const;
  bool cross_free_space(Path<C>& path, Sample& sample) const;
  bool cross_medium(Path<C>& path, Sample& sample) const;
  bool first_crossing(Path<C>& path, Sample& sample) const;
  bool meet_surface(Path<C>& path, const Hit& hit, Sample& sample) const;
  bool meet_dielectric(Path<C>& path, const Hit& hit, double ior_ahead, Sample& sample) const;
  bool scatter_in_medium(Path<C>& path, Sample& sample) const;
  bool scatter_on_surface(Path<C>& path, const Hit& hit, Sample& sample) const;
  // Roulette: a path below `least` of its full weight goes on with that weight or not at all.
  static bool survives(Path<C>& path, double least, Rng& rng);

  // Light that a flight passes or runs into.
  void see_area_lights(const Path<C>& path, double length, Sample& sample) const;
  void see_sky(const Path<C>& path, Sample& sample) const;
  // Light that the first `length` of the way ahead scatters out of that of point lights in the same
  // medium.
  void light_along(const Path<C>& path, double length, Sample& sample) const;
  // What the density of finding a light next time has to be compared with: that of finding it by
  // next-event estimation from the last vertex, 1/sr there; 0 if that cannot be.
  double area_density(const Path<C>& path, const typename LightTable<C>::Area& light,
                      double distance) const;
  double sky_density(const Path<C>& path, const EnvironmentMap& map) const;
  // Light that reaches a vertex straight from the lights, or refracted once on its way into the
  // vertex's medium.
  void next_event(const Path<C>& path, const PathVertex<C>& vertex, Sample& sample) const;
  void refracted_next_event(const Path<C>& path, const PathVertex<C>& vertex, Sample& sample) const;
  // Optical depth along the straight way; nothing if something other than index-matched media is in
  // the way.
  std::optional<Channels<C>> depth(PathRay ray, double distance) const;

  const Scene& scene_;
  PathSurfaces surfaces_;
  std::vector<Optics<C>> optics_;  // per object; of no meaning for diffuse ones
  // Per object; null if its surface is not a smooth dielectric.
  std::vector<std::unique_ptr<const RefractingSurface>> refracting_;
  LightTable<C> lights_;
};

}  // namespace knotlight
