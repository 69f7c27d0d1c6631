#include "photon/beams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace knotlight {
namespace {

using std::numbers::pi;

// Directions within 5.7 degrees of a beam's first photon belong to it: wider than a ball of less
// than a mean free path spreads the rays of a lamp or of a curved surface, narrower than a sky.
constexpr double least_cosine = 0.995;
// More lights than this at one point are treated as light from everywhere.
constexpr std::size_t most_beams = 6;
// A beam with a smaller part of the photons costs more lines than it removes error.
constexpr double least_share = 0.1;

// Two sets of few lines; where their sums agree to this part, their mean is better still. Where
// they do not (an edge of the object, or of its own shadow, crosses the ball), one set of many.
constexpr std::size_t few_lines = 32;
constexpr std::size_t many_lines = 384;
constexpr double agreement = 0.005;
// Of the ray caster's skip distance: well above rounding, 2e-6 of the scene.
constexpr double inset_in_skips = 20.0;
constexpr int most_faces_left = 3;  // those of a corner of a box
// Radians over the radius of the ball: rays that close in faster meet within it, and there is no
// bundle to follow.
constexpr double largest_spread = 0.5;

// 5-point Gauss-Legendre rule on (-1, 1): what is integrated is a polynomial of degree 4 times an
// exponential over at most a few mean free paths.
constexpr std::array<double, 5> gauss_nodes{-0.906179845938664, -0.538469310105683, 0.0,
                                            0.538469310105683, 0.906179845938664};
constexpr std::array<double, 5> gauss_weights{
    0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366, 0.236926885056189};

// The parts of a ray inside the object, as distances from its origin, increasing.
struct Segment {
  double begin, end;
};
void find_segments(const Vec3& origin, const Vec3& d, const RayCaster& caster, std::uint32_t object,
                   std::vector<Segment>& segments) {
  segments.clear();
  double entered = 0.0;  // inside from the start, if the first crossing leaves
  for (const RayCaster::Crossing& crossing :
       caster.crossings({origin, d, std::numeric_limits<double>::infinity()}, object)) {
    if (crossing.leaving)
      segments.push_back({entered, crossing.t});
    else
      entered = crossing.t;
  }
}

// Way inside the object before segment `i` of a line followed against the light.
double way_before(const std::vector<Segment>& segments, std::size_t i, bool straight) {
  double way = 0.0;
  if (straight)
    for (std::size_t j = i + 1; j < segments.size(); ++j)
      way += segments[j].end - segments[j].begin;
  return way;
}

// Direction at the centre and spread, by least squares of d = direction + spread u over the part of
// u across the beam.
void fit_spread(const std::vector<Vec3>& directions, const std::vector<Vec3>& offsets, Beam& beam) {
  Vec3 mean = Vec3::Zero();
  Vec3 center = Vec3::Zero();
  const double n = static_cast<double>(beam.members.size());
  for (const std::size_t i : beam.members) {
    mean += directions[i] / n;
    center += offsets[i] / n;
  }
  const auto across = [&](const Vec3& u) {
    return Vec3(u - u.dot(mean) / mean.squaredNorm() * mean);
  };
  double product = 0.0;
  double square = 0.0;
  for (const std::size_t i : beam.members) {
    const Vec3 u = across(offsets[i] - center);
    product += u.dot(directions[i]);
    square += u.squaredNorm();
  }
  if (square > 0.0) beam.spread = product / square;
  beam.direction = (mean - beam.spread * across(center)).normalized();
}

// What the lines of one ball have in common.
struct LineSum {
  Vec3 x;
  Beam beam;
  double r;
  RadialKernel kernel;
  double sigma_t;
  bool straight;
  const RayCaster& caster;
  std::uint32_t object;
  double way_to_x = 0.0;

  // Lines spread evenly over a disc across the beam through x: line i at area (i + shift)/count,
  // golden-angle turns. Where the rays of the beam spread, as many pass each part of the disc as
  // pass any other section of their bundle: the irradiance falls as the section grows.
  double over(std::size_t count, double shift, double turn) const {
    const Frame frame(beam.direction);
    const double disc =
        r / std::sqrt(1.0 - std::pow(beam.spread * r, 2));  // its cone holds the ball
    const double golden_angle = pi * (3.0 - std::sqrt(5.0));
    std::vector<Segment> segments;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double rho =
          disc * std::sqrt((static_cast<double>(i) + shift) / static_cast<double>(count));
      const double phi = turn + golden_angle * static_cast<double>(i);
      const Vec3 across = frame.to_world({rho * std::cos(phi), rho * std::sin(phi), 0.0});
      sum += along(across, (beam.direction + beam.spread * across).normalized(), segments);
    }
    return pi * disc * disc / static_cast<double>(count) * sum;
  }

  // Over the part inside ball and object of the line through x + across.
  double along(const Vec3& across, const Vec3& d, std::vector<Segment>& segments) const {
    const double to_middle = -across.dot(d);
    const double rho2 = (across + to_middle * d).squaredNorm();
    if (rho2 >= r * r) return 0.0;
    const double half = std::sqrt(r * r - rho2);
    // From the end of the chord against the light.
    find_segments(x + across + (to_middle + half) * d, -d, caster, object, segments);
    double sum = 0.0;
    for (std::size_t j = 0; j < segments.size() && segments[j].begin < 2.0 * half; ++j) {
      const double middle = 0.5 * (segments[j].begin + std::min(segments[j].end, 2.0 * half));
      const double reach = middle - segments[j].begin;
      const double before = way_before(segments, j, straight) - way_to_x;
      for (std::size_t k = 0; k < gauss_nodes.size(); ++k) {
        const double back = middle + reach * gauss_nodes[k];
        const double s2 = (rho2 + (half - back) * (half - back)) / (r * r);
        sum += gauss_weights[k] * reach * kernel_value(kernel, s2) *
               std::exp(-sigma_t * (before + segments[j].end - back));
      }
    }
    return sum;
  }
};

}  // namespace

Beams find_beams(const std::vector<Vec3>& directions, const std::vector<Vec3>& offsets) {
  Beams result;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const auto found =
        std::find_if(result.beams.begin(), result.beams.end(), [&](const Beam& beam) {
          return directions[beam.members.front()].dot(directions[i]) > least_cosine;
        });
    if (found != result.beams.end())
      found->members.push_back(i);
    else if (result.beams.size() < most_beams)
      result.beams.push_back({Vec3::Zero(), 0.0, {i}});
    else
      result.others.push_back(i);
  }
  std::erase_if(result.beams, [&](const Beam& beam) {
    if (static_cast<double>(beam.members.size()) >=
        least_share * static_cast<double>(directions.size()))
      return false;
    result.others.insert(result.others.end(), beam.members.begin(), beam.members.end());
    return true;
  });
  for (Beam& beam : result.beams) fit_spread(directions, offsets, beam);
  return result;
}

double beam_mass(const Vec3& x, const Beam& beam, double r, RadialKernel kernel, double sigma_t,
                 bool straight, const RayCaster& caster, std::uint32_t object) {
  LineSum sum{x, beam, r, kernel, sigma_t, straight, caster, object};
  sum.beam.spread = std::clamp(beam.spread * r, -largest_spread, largest_spread) / r;
  std::vector<Segment> segments;
  // A ray from the surface itself would be in or out by rounding where light glides along a face.
  // At an edge or a corner it has to leave each face that meets there.
  const double inset = inset_in_skips * caster.skip_distance();
  Vec3 inner = x;
  for (int face = 0; face < most_faces_left; ++face) {
    const SurfacePoint surface = caster.nearest_surface_point(inner, object);
    if (face > 0 && (surface.position - inner).norm() > 0.5 * inset) break;
    inner -= inset * surface.normal;
  }
  find_segments(inner, -beam.direction, caster, object, segments);
  if (!segments.empty() && segments.front().begin == 0.0)
    sum.way_to_x = segments.front().end + way_before(segments, 0, straight);
  const double a = sum.over(few_lines, 0.25, 0.0);
  const double b = sum.over(few_lines, 0.75, pi);
  if (std::abs(a - b) < agreement * (a + b)) return 0.5 * (a + b);
  return sum.over(many_lines, 0.5, 0.0);
}

}  // namespace knotlight
