// The light that comes to the eye along a ray, in a scene whose translucent objects are solved.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/rng.h"
#include "render/exitance.h"
#include "render/gather.h"
#include "render/surface_grid.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

// What the picture needs of one solved translucent object.
struct GlowingSurface {
  explicit GlowingSurface(SurfaceGrid nodes) : grid(std::move(nodes)) {}

  SurfaceGrid grid;
  std::vector<Eigen::VectorXd> U_d;      // per channel, one value per grid node, W/(length^2 sr)
  std::vector<LeavingRadiance> leaving;  // per channel
  InsideField inside;  // exitance gather looks into the object; else without channels
  // For models that look at the surface, and whose U_d lacks light that is scattered once: an
  // estimate of that, outside the object, W/(length^2 sr). Empty: nothing is to be added.
  std::function<Spectrum(const Ray& ray, const Hit& hit, const Vec3& normal, double depth_sample,
                         Rng& rng)>
      once_scattered;
};

// One per scene object, empty for diffuse ones.
using GlowingSurfaces = std::vector<std::optional<GlowingSurface>>;

// What the object that is seen sends to the eye, W/(length^2 sr).
struct ScatteredLight {
  Spectrum once = Spectrum::Zero();  // scattered in it once
  Spectrum more = Spectrum::Zero();  // scattered in it more than once, or emitted
};

class Shading {
 public:
  // All three must outlive it; caster was built from scene.objects in order.
  Shading(const Scene& scene, const RayCaster& caster, const GlowingSurfaces& surfaces);

  // One Monte Carlo estimate of the radiance that arrives along the ray, W/(length^2 sr).
  // depth_sample in [0, 1): spread it evenly over the rays of one pixel (Gather). May be called
  // from several threads. scattered: also told how much of it is light that a gathered object
  // scattered; what remains was mirrored, shone through, or came from other objects.
  Spectrum radiance(const Ray& ray, double depth_sample, Rng& rng,
                    ScatteredLight* scattered = nullptr) const;
  Spectrum radiance(const Ray& ray, Rng& rng) const { return radiance(ray, rng.uniform(), rng); }
  // The solution on the surface of a translucent object, W/(length^2 sr), per channel; beyond P1
  // completed as while gathering, by the mean of so many estimates.
  Spectrum solution_at(const Hit& hit, int samples, Rng& rng) const;

 private:
  // A ray under way: whether the eye sees along it, or light is looked for (OutsideRay).
  struct Look {
    int bounces;
    bool seen;
    double depth_sample;
    bool leaving = false;  // OutsideRay
    ScatteredLight* scattered = nullptr;
  };
  Spectrum radiance(const Ray& ray, const Look& look, Rng& rng) const;
  Spectrum translucent_radiance(const Ray& ray, const Hit& hit, const TranslucentMaterial& material,
                                const Look& look, Rng& rng) const;
  Spectrum surface_radiance(const Hit& hit, const Vec3& normal, double cosine,
                            const TranslucentMaterial& material, Rng& rng) const;
  Spectrum glow_reflected(const Hit& hit, const Vec3& direction, Rng& rng) const;
  Spectrum seen_through(const Ray& ray, const Hit& hit, const TranslucentMaterial& material,
                        const Look& look, Rng& rng) const;
  Vec3 shading_normal(const Hit& hit) const;

  const Scene& scene_;
  const RayCaster& caster_;
  const GlowingSurfaces& surfaces_;
  std::vector<std::optional<Gather>> gathers_;     // one per object
  std::vector<std::vector<Vec3>> smooth_normals_;  // 3 per triangle; empty: use the hit's normal
};

}  // namespace knotlight
