// A scene as plain data, in world space, checked. What each field means and its unit:
// docs/scene-format.md. Lengths are in the scene's unit; directions are of travel and unit length.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/bkm_choices.h"
#include "core/environment_map.h"
#include "core/medium.h"
#include "core/shape.h"
#include "core/vec3.h"

namespace knotlight {

struct Camera {
  enum class Type { perspective, orthographic };
  Type type = Type::perspective;
  Vec3 from = Vec3(0, -5, 0);
  Vec3 to = Vec3::Zero();
  Vec3 up = Vec3::UnitZ();
  double fov = 40.0;   // vertical, degrees; perspective only
  double width = 1.0;  // of the picture in scene units; orthographic only
  int width_px = 640;
  int height_px = 480;
  int samples = 16;  // per pixel
};

struct PointLight {
  Vec3 position = Vec3::Zero();
  Spectrum intensity = Spectrum::Zero();  // W/sr
};
struct DirectionalLight {
  Vec3 direction = -Vec3::UnitZ();         // of travel, unit
  Spectrum irradiance = Spectrum::Zero();  // W per area normal to it
};
struct AreaLight {  // parallelogram center +-u +-v, shining from the side u x v points to
  Vec3 center = Vec3::Zero();
  Vec3 u = Vec3::UnitX();
  Vec3 v = Vec3::UnitY();
  Spectrum radiance = Spectrum::Zero();  // W/(length^2 sr)

  Vec3 normal() const { return u.cross(v).normalized(); }
  double area() const { return 4.0 * u.cross(v).norm(); }
};
struct EnvironmentLight {
  Spectrum radiance = Spectrum::Zero();       // W/(length^2 sr); multiplies the map
  std::shared_ptr<const EnvironmentMap> map;  // null: the same from everywhere
};
using Light = std::variant<PointLight, DirectionalLight, AreaLight, EnvironmentLight>;

struct TranslucentMaterial {
  Spectrum sigma_a = Spectrum::Zero();  // 1/length
  Spectrum sigma_s = Spectrum::Zero();  // 1/length
  Spectrum g = Spectrum::Zero();
  double ior = 1.0;
  Spectrum emission = Spectrum::Zero();  // E, W/length^3
  double roughness = 0.0;                // of the surface, 0..1

  // Slope of the surface's facets (core/microfacet.h); 0: smooth, or not to be seen since ior = 1.
  double alpha() const { return ior == 1.0 ? 0.0 : roughness * roughness; }
  Medium medium(int channel) const {
    return {sigma_a[channel], sigma_s[channel], g[channel], ior, emission[channel]};
  }
};
struct DiffuseMaterial {
  // 0..1; times the colour of the surface where it has one (trace/surroundings.h).
  Spectrum reflectance = Spectrum::Zero();
};
using Material = std::variant<TranslucentMaterial, DiffuseMaterial>;

struct Object {
  std::string name;
  Shape shape;  // world space; closed and outward-oriented if translucent
  Material material;

  const TranslucentMaterial* translucent() const {
    return std::get_if<TranslucentMaterial>(&material);
  }
};

enum class SourceModel { photon_map, irradiance_sampling, irradiance_thesis, boundary_flux };
enum class Method { automatic, bkm_thesis, bkm, mfs, lbkm, grid };
enum class Exitance { gather, p1, lambert, mean_intensity };
// What is solved for light that was scattered more than once: the P1 equation, or an equation for
// the part of it that reaches far, and the near part exactly (core/asymptotic.h).
enum class Diffusion { p1, grosjean, asymptotic };
enum class Divergence { identity, differentiated };
// Where light that has not been scattered yet is counted: at points along each ray inside the
// object, weighted by what they are expected to receive, or at one random collision per photon.
enum class Deposits { expected_values, collisions };
enum class DensityEstimator { nearest, radius, kernel };

// Keys of the boundary knot method as the thesis has it; std::nullopt = chosen from the scene.
struct BkmThesisSettings {
  KnotLayout knot_layout = KnotLayout::jittered;
  InteriorLayout interior_knots = InteriorLayout::two_layers;
  RadialKind radial_function = RadialKind::gaussian;
  std::optional<double> radial_exponent;  // b of the two multiquadrics
  int radial_order = 1;                   // m of RadialKind::nonsingular
  std::optional<double> shape_parameter;  // width c, in mean knot spacings
  bool leave_one_out = false;             // choose the width by leave-one-out instead
  int basis_order = 0;                    // m of the boundary basis
  DenseMethod dense_solver = DenseMethod::svd;
  std::optional<double> svd_cut;  // relative to the largest singular value
  DistancePrecision distance_precision = DistancePrecision::double_precision;
};

// Keys left out of the scene stay at these defaults; std::nullopt = chosen from the scene.
struct SolverSettings {
  double tolerance = 0.01;  // relative error aimed at
  std::optional<SourceModel> source;
  Method method = Method::automatic;
  Boundary boundary = Boundary::milne;
  std::optional<Exitance> exitance;
  std::optional<Diffusion> diffusion;
  std::size_t photons = 2'000'000;   // emitted towards the translucent objects, per channel
  bool photons_at_most = false;      // fewer will do if their noise allows (pipeline/photon_budget)
  std::optional<std::size_t> knots;  // on the boundary of each object
  BkmThesisSettings thesis;
  std::optional<std::size_t> estimate_photons;  // nearest photons in a density estimate
  Divergence divergence = Divergence::identity;
  std::optional<Deposits> deposits;
  std::optional<std::size_t> irradiance_samples;  // per object; irradiance models only
  // Follow light that left and enters again; left out: with Boundary::milne.
  std::optional<bool> returning_light;
  bool similarity = false;  // replace (sigma_s, g) by ((1 - g) sigma_s, 0)
  DensityEstimator estimator = DensityEstimator::nearest;
  std::optional<double> estimate_radius;  // of the ball of a density estimate, mean free paths
};

struct Scene {
  std::string units;
  int channels = 1;  // 1 or 3
  Camera camera;
  std::vector<Light> lights;
  std::vector<Object> objects;
  SolverSettings solver;
  std::vector<std::string> warnings;  // what was mended on the way in, one line each
};

}  // namespace knotlight
