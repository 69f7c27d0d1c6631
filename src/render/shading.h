// The light that comes to the eye along a ray, in a scene whose translucent objects are solved.
#pragma once

#include <Eigen/Core>
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
};

// One per scene object, empty for diffuse ones.
using GlowingSurfaces = std::vector<std::optional<GlowingSurface>>;

class Shading {
 public:
  // All three must outlive it; caster was built from scene.objects in order.
  Shading(const Scene& scene, const RayCaster& caster, const GlowingSurfaces& surfaces);

  // One Monte Carlo estimate of the radiance that arrives along the ray, W/(length^2 sr).
  // depth_sample in [0, 1): spread it evenly over the rays of one pixel (Gather). May be called
  // from several threads.
  Spectrum radiance(const Ray& ray, double depth_sample, Rng& rng) const;
  Spectrum radiance(const Ray& ray, Rng& rng) const { return radiance(ray, rng.uniform(), rng); }
  // How light is collected inside the object; null where the exitance looks at its surface alone.
  const Gather* gather(std::uint32_t object) const {
    return gathers_[object] ? &*gathers_[object] : nullptr;
  }

 private:
  // A ray under way: whether the eye sees along it, or light is looked for (OutsideRay).
  struct Look {
    int bounces;
    bool seen;
    double depth_sample;
    bool leaving = false;  // OutsideRay
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
