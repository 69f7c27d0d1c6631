// Small scenes and estimates from them, for the tests of the path tracer.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/sampling.h"
#include "reference/path_tracer.h"
#include "support/statistics.h"

namespace knotlight::test {

inline Spectrum grey(double x) {
  return Spectrum::Constant(x);
}

inline TranslucentMaterial medium(double sigma_a, double sigma_s, double g = 0.0, double ior = 1.0,
                                  double emission = 0.0) {
  TranslucentMaterial m;
  m.sigma_a = grey(sigma_a);
  m.sigma_s = grey(sigma_s);
  m.g = grey(g);
  m.ior = ior;
  m.emission = grey(emission);
  return m;
}

inline Object ball(const Material& material, double radius = 1.0, const Vec3& at = Vec3::Zero()) {
  return {"ball", Sphere{at, radius}, material};
}

inline Object block(const Material& material, const Vec3& lo, const Vec3& hi) {
  return {"block", box_mesh(lo, hi), material};
}

inline DiffuseMaterial diffuse(double reflectance) {
  return {grey(reflectance)};
}

inline EnvironmentLight sky(double radiance) {
  return {grey(radiance), nullptr};
}

// The same from everywhere too, but given as a picture, which next-event estimation samples.
inline EnvironmentLight pictured_sky(double radiance) {
  return {grey(radiance),
          std::make_shared<EnvironmentMap>(8, 4, std::vector<Spectrum>(32, grey(1.0)))};
}

// Six area lights around the origin that shine inwards: from within, a sky of that radiance.
inline std::vector<Light> bright_room(double half_width, double radiance) {
  std::vector<Light> lights;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 inwards = -side * Vec3::Unit(axis);
      const Vec3 u = half_width * Vec3::Unit((axis + 1) % 3);
      lights.push_back(AreaLight{-half_width * inwards, u, inwards.cross(u), grey(radiance)});
    }
  return lights;
}

// A scene that is kept, with what traces it.
class Traced {
 public:
  Traced(std::vector<Light> lights, std::vector<Object> objects, int channel_count = 1) {
    scene_.lights = std::move(lights);
    scene_.objects = std::move(objects);
    scene_.channels = channel_count;
    std::vector<const Shape*> shapes;
    for (const Object& object : scene_.objects) shapes.push_back(&object.shape);
    caster_ = std::make_unique<RayCaster>(shapes);
    tracer_ = std::make_unique<PathTracer>(scene_, *caster_);
  }
  const Scene& scene() const { return scene_; }
  const RayCaster& caster() const { return *caster_; }
  const PathTracer& tracer() const { return *tracer_; }

  // Mean over n eye rays, each with a random stream of its own.
  Mean mean(std::size_t n, const std::function<Ray(Rng&)>& eye, int channel = 0) const {
    Mean found;
    for (std::size_t i = 0; i < n; ++i) {
      Rng rng(7, Stream::tests, i);
      const Ray ray = eye(rng);
      found.add(tracer_->radiance(ray, rng)[channel]);
    }
    return found;
  }

 private:
  Scene scene_;
  std::unique_ptr<RayCaster> caster_;
  std::unique_ptr<PathTracer> tracer_;
};

// Eye rays downwards, spread evenly over the disc x^2 + y^2 < radius^2.
inline std::function<Ray(Rng&)> over_disc(double radius = 1.0) {
  return [radius](Rng& rng) {
    const double u = rng.uniform();
    const Eigen::Vector2d p = radius * sample_disc(u, rng.uniform());
    return Ray{Vec3(p.x(), p.y(), 5.0), -Vec3::UnitZ()};
  };
}

inline std::function<Ray(Rng&)> along(const Vec3& origin, const Vec3& direction) {
  return [origin, direction](Rng&) { return Ray{origin, direction.normalized()}; };
}

// Two-sided, false alarms 1e-6 per check: the mean of thousands of independent samples is normal.
// known_to: how exactly the expected value is known.
inline void expect_mean(const Mean& found, double expected, double known_to = 0.0) {
  constexpr double rounding = 1e-9;  // where samples hardly scatter
  const double error = found.standard_error();
  EXPECT_NEAR(found.mean(), expected, z_one_in_a_million * error + known_to + rounding)
      << "z = " << (found.mean() - expected) / error << ", n = " << found.n;
}

}  // namespace knotlight::test
