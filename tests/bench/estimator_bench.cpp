// Density estimates of U_ri and Q_ri against their closed forms: error over radius, count, depth
// and number of photons, bias and noise apart, seconds; and the divergence of Q_ri, known or
// differentiated. Writes CSV into a folder; docs/results/estimators.gp draws the charts from it.
//
//   estimator_bench DIR [n | settings | depth | divergence | --quick]
//
// --quick: all four with few photons at few points: that they run, not what is true.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "../photon/photon_scenes.h"
#include "photon/first_light_tracer.h"
#include "photon/photon_map.h"
#include "photon/source_terms.h"
#include "reference/first_light.h"

namespace knotlight {
namespace {

using testing_scenes::caster_of;
using testing_scenes::parallel_light;
using testing_scenes::scene_of;
using testing_scenes::torus_mesh;
using testing_scenes::translucent;

// How much is measured.
struct Effort {
  std::size_t volume_points = 700;
  std::size_t surface_points = 700;
  std::vector<std::size_t> counts{10'000, 30'000, 100'000, 300'000, 1'000'000, 4'000'000};
  std::size_t photons = 1'000'000;  // where their number is not varied
};
const Effort quick{30, 30, {3'000, 10'000}, 10'000};

constexpr double layer = 0.1;  // mean free paths

// Of the processor, in this one thread: the figures do not depend on what else the machine does.
double seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// One object, index-matched, with what the estimates should be.
struct Case {
  std::string name;
  Medium medium;
  Scene scene;
  std::unique_ptr<RayCaster> caster;
  std::function<UnscatteredLight(const Vec3&)> exact;
};

Medium medium_of(double sigma_t) {
  return {0.1 * sigma_t, 0.9 * sigma_t, 0.5, 1.0, 0.0};
}

PathLength path_in(const RayCaster& caster) {
  return [&caster](const Vec3& x, const Vec3& d, double t_max) {
    return caster.path_length_inside({x, d, t_max}, 0);
  };
}

Case beam_case(const std::string& name, const Shape& shape, double sigma_t, const Vec3& direction) {
  Case c{name, medium_of(sigma_t), {}, nullptr, {}};
  c.scene = scene_of({parallel_light(direction, 1.0)}, {translucent(shape, c.medium)});
  c.caster = caster_of(c.scene);
  c.exact = [medium = c.medium, direction, path = path_in(*c.caster)](const Vec3& x) {
    return first_light_directional(x, direction, 1.0, medium, path);
  };
  return c;
}

Case make_case(const std::string& name) {
  const Shape box = box_mesh(Vec3(-5, -5, -5), Vec3(5, 5, 0));
  if (name == "slab") return beam_case(name, box, 1.0, -Vec3::UnitZ());
  if (name == "slab_oblique") return beam_case(name, box, 1.0, Vec3(0.6, 0, -0.8));
  if (name == "sphere") return beam_case(name, Sphere{}, 5.0, -Vec3::UnitZ());
  if (name == "sphere_20") return beam_case(name, Sphere{}, 20.0, -Vec3::UnitZ());
  const Vec3 lamp(1.5, 1.0, 2.0);
  Case c{name, medium_of(5.0 / 0.35), {}, nullptr, {}};
  c.scene = scene_of({PointLight{lamp, Spectrum::Constant(1.0)}},
                     {translucent(torus_mesh(80, 40), c.medium)});
  c.caster = caster_of(c.scene);
  c.exact = [medium = c.medium, lamp, path = path_in(*c.caster)](const Vec3& x) {
    return first_light_point(x, lamp, 1.0, medium, path);
  };
  return c;
}

struct Photons {
  std::vector<VolumePhoton> list;
  double trace_seconds;
};

// random: one collision per photon by dice. low_discrepancy: the same at low-discrepancy points of
// (position, direction, depth).
Photons photons(const Case& c, std::size_t n, std::uint64_t seed, const std::string& scheme) {
  const double start = seconds();
  Photons result;
  if (scheme == "random") {
    result.list =
        testing_scenes::trace(c.scene, TracerOptions::Orders::first, n, true, 1, seed).photons[0];
  } else {
    Stages stages(false);
    Stage stage(stages, "photons", n);
    FirstLightOptions options;
    options.rays = n;
    options.points_per_ray = 1;
    options.seed = seed;
    result.list = trace_first_light(c.scene, *c.caster, 0, options, Workers(1), stage).photons[0];
  }
  result.trace_seconds = seconds() - start;
  return result;
}

// Uniform in the volume; uniform on the surface; the same at depths uniform in (0, layer).
struct Places {
  std::vector<Vec3> volume, layer, surface;
  std::vector<Vec3> normals;  // of the surface points
};
Places places(const Case& c, const Effort& effort) {
  Places p;
  const Shape& shape = c.scene.objects[0].shape;
  const Bounds box = bounds(shape);
  Rng rng(7, Stream::tests, 0);
  while (p.volume.size() < effort.volume_points) {
    Vec3 x;
    for (int i = 0; i < 3; ++i) x[i] = box.lo[i] + (box.hi[i] - box.lo[i]) * rng.uniform();
    if (c.caster->inside(x, 0)) p.volume.push_back(x);
  }
  for (const SurfacePoint& s :
       stratified_surface_points(shape, effort.surface_points, true, 3, Stream::tests)) {
    p.surface.push_back(s.position);
    p.normals.push_back(s.normal);
    const Vec3 x = s.position - layer * rng.uniform() / c.medium.sigma_t() * s.normal;
    if (c.caster->inside(x, 0)) p.layer.push_back(x);
  }
  return p;
}

struct Errors {
  double U, Q;  // relative L2
  double estimates_per_second;
};
Errors errors(const Case& c, const VolumePhotonMap& map, const EstimateOptions& options,
              const std::vector<Vec3>& points) {
  double U = 0.0, U_norm = 0.0, Q = 0.0, Q_norm = 0.0;
  double time = 0.0;
  for (const Vec3& x : points) {
    const UnscatteredLight exact = c.exact(x);
    const double start = seconds();
    const ReducedIncident r = map.estimate(x, options, *c.caster, 0);
    time += seconds() - start;
    U += std::pow(r.U_ri - exact.U_ri, 2);
    U_norm += exact.U_ri * exact.U_ri;
    Q += (r.Q_ri - exact.Q_ri).squaredNorm();
    Q_norm += exact.Q_ri.squaredNorm();
  }
  return {std::sqrt(U / U_norm), std::sqrt(Q / Q_norm), static_cast<double>(points.size()) / time};
}

const std::vector<std::string> cases{"slab", "slab_oblique", "sphere", "sphere_20", "torus"};
const std::vector<std::string> schemes{"random", "low_discrepancy"};

// The estimate this program started with: attenuation undone along each ray, nothing else.
EstimateOptions carried(std::size_t nearest, double radius) {
  return {nearest, radius, true, DensityEstimator::nearest, false, false};
}

void write_n(const std::string& folder, const Effort& effort) {
  std::ofstream out(folder + "/n.csv");
  out << "case,scheme,n,stored,nearest,U_volume,Q_volume,U_layer,Q_layer,U_surface,Q_surface,"
         "estimates_per_s,trace_s,tree_s\n";
  for (const std::string& name : cases) {
    const Case c = make_case(name);
    const Places p = places(c, effort);
    for (const std::string& scheme : schemes)
      for (const std::size_t n : effort.counts) {
        Photons traced = photons(c, n, 1, scheme);
        const double start = seconds();
        const VolumePhotonMap map(std::move(traced.list), c.medium);
        const double tree = seconds() - start;
        const EstimateOptions options = default_estimate(map.size());
        const Errors v = errors(c, map, options, p.volume);
        const Errors l = errors(c, map, options, p.layer);
        const Errors s = errors(c, map, options, p.surface);
        out << fmt::format(
            "{},{},{},{},{},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.0f},{:.3f},{:.3f}\n", name,
            scheme, n, map.size(), options.nearest, v.U, v.Q, l.U, l.Q, s.U, s.Q,
            v.estimates_per_second, traced.trace_seconds, tree);
        out.flush();
      }
  }
}

// Root mean squares over the points of the layer, relative to that of U_ri: of what the mean over
// the seeds is off, and of the spread around it.
void write_settings(const std::string& folder, const Effort& effort) {
  const std::size_t n = effort.photons;
  constexpr int seeds = 4;
  std::ofstream out(folder + "/settings.csv");
  out << "case,scheme,estimator,nearest,max_radius,bias,noise,estimates_per_s\n";
  struct Setting {
    std::string name;
    EstimateOptions options;
  };
  std::vector<Setting> settings;
  for (const std::size_t k : {200, 500, 1000, 2000, 4000}) {
    settings.push_back({"carried", carried(k, 1.0)});
    settings.push_back({"slope", {k, 1.0, true, DensityEstimator::nearest, false, true}});
    settings.push_back({"nearest", {k, 1.0}});
    settings.push_back({"kernel", {k, 1.0, true, DensityEstimator::kernel}});
  }
  for (const double r : {0.3, 0.5, 0.7, 1.0})
    settings.push_back({"radius", {2, r, true, DensityEstimator::radius}});
  for (const std::string name : {"slab_oblique", "sphere", "torus"}) {
    const Case c = make_case(name);
    const std::vector<Vec3> layer_points = places(c, effort).layer;
    std::vector<Vec3> points;  // every third: they follow each other along the surface
    for (std::size_t i = 0; i < layer_points.size(); i += 3) points.push_back(layer_points[i]);
    for (const std::string& scheme : schemes) {
      std::vector<VolumePhotonMap> maps;
      for (int seed = 1; seed <= seeds; ++seed)
        maps.emplace_back(photons(c, n, static_cast<std::uint64_t>(seed), scheme).list, c.medium);
      for (const Setting& s : settings) {
        double bias2 = 0.0, noise2 = 0.0, norm = 0.0;
        const double start = seconds();
        for (const Vec3& x : points) {
          double sum = 0.0, squares = 0.0;
          for (const VolumePhotonMap& map : maps) {
            const double U = map.estimate(x, s.options, *c.caster, 0).U_ri;
            sum += U;
            squares += U * U;
          }
          const double exact = c.exact(x).U_ri;
          const double mean = sum / seeds;
          const double variance = (squares - seeds * mean * mean) / (seeds - 1);
          noise2 += variance;
          bias2 += std::pow(mean - exact, 2) - variance / seeds;
          norm += exact * exact;
        }
        const double rate = seeds * static_cast<double>(points.size()) / (seconds() - start);
        out << fmt::format("{},{},{},{},{},{:.5f},{:.5f},{:.0f}\n", name, scheme, s.name,
                           s.options.nearest, s.options.max_radius,
                           std::sqrt(std::max(0.0, bias2) / norm), std::sqrt(noise2 / norm), rate);
        out.flush();
      }
    }
  }
}

void write_depth(const std::string& folder, const Effort& effort) {
  const std::size_t n = effort.photons;
  std::ofstream out(folder + "/depth.csv");
  out << "case,depth,carried,random,low_discrepancy\n";
  for (const std::string name : {"slab_oblique", "sphere", "torus"}) {
    const Case c = make_case(name);
    const Places p = places(c, effort);
    const VolumePhotonMap dice(photons(c, n, 1, "random").list, c.medium);
    const VolumePhotonMap even(photons(c, n, 1, "low_discrepancy").list, c.medium);
    for (const double depth : {0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6}) {
      std::vector<Vec3> points;
      for (std::size_t i = 0; i < p.surface.size(); ++i) {
        const Vec3 x = p.surface[i] - depth / c.medium.sigma_t() * p.normals[i];
        if (depth == 0.0 || c.caster->inside(x, 0)) points.push_back(x);
      }
      out << fmt::format("{},{},{:.5f},{:.5f},{:.5f}\n", name, depth,
                         errors(c, dice, carried(200, 0.25), points).U,
                         errors(c, dice, default_estimate(dice.size()), points).U,
                         errors(c, even, default_estimate(even.size()), points).U);
      out.flush();
    }
  }
}

// Relative L2 error of f, whose two parts are known: f = source_per_U_ri * U_ri.
void write_divergence(const std::string& folder, const Effort& effort) {
  std::ofstream out(folder + "/divergence.csv");
  out << "scheme,n,depths,step,identity,differentiated\n";
  const Case c = make_case("slab_oblique");
  const DiffusionCoefficients d = diffusion_coefficients(c.medium, Boundary::milne);
  const Places p = places(c, effort);
  std::vector<Vec3> deep;  // a step of 0.8 and a ball of 0.25 stay inside
  for (const Vec3& x : p.volume)
    if (x.z() < -1.05 && std::abs(x.x()) < 3.9 && std::abs(x.y()) < 3.9) deep.push_back(x);
  for (const std::string& scheme : schemes)
    for (const std::size_t n : {effort.photons / 10, effort.photons}) {
      const VolumePhotonMap map(photons(c, n, 1, scheme).list, c.medium);
      const auto error_of = [&](const std::vector<Vec3>& points, const SourceTermOptions& options) {
        double sum = 0.0, norm = 0.0;
        for (const Vec3& x : points) {
          const double exact = d.source_per_U_ri * c.exact(x).U_ri;
          sum += std::pow(source_term(x, map, c.medium, options, *c.caster, 0) - exact, 2);
          norm += exact * exact;
        }
        return std::sqrt(sum / norm);
      };
      for (const bool inside : {true, false})
        for (const double step : {0.05, 0.1, 0.2, 0.4, 0.8}) {
          const std::vector<Vec3>& points = inside ? deep : p.surface;
          SourceTermOptions identity;
          identity.estimate = default_estimate(map.size());
          SourceTermOptions differentiated;
          differentiated.estimate = carried(default_estimate(map.size()).nearest, 0.25);
          differentiated.divergence = Divergence::differentiated;
          differentiated.difference_step = step;
          out << fmt::format("{},{},{},{},{:.5f},{:.5f}\n", scheme, n,
                             inside ? "inside" : "surface", step, error_of(points, identity),
                             error_of(points, differentiated));
          out.flush();
        }
    }
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  using namespace knotlight;
  if (argc < 2) {
    fmt::print(stderr, "estimator_bench DIR [n | settings | depth | divergence | --quick]\n");
    return 2;
  }
  const std::string folder = argv[1];
  const std::string part = argc > 2 ? argv[2] : "";
  const bool all = part.empty() || part == "--quick";
  const Effort effort = part == "--quick" ? quick : Effort{};
  if (all || part == "n") write_n(folder, effort);
  if (all || part == "settings") write_settings(folder, effort);
  if (all || part == "depth") write_depth(folder, effort);
  if (all || part == "divergence") write_divergence(folder, effort);
  return 0;
}
