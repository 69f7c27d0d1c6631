// Light that comes in beams: where all photons of a ball fly along one direction, how it falls off
// across the ball is known from the shape alone, whatever the beam's strength.
#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"
#include "photon/ball_volume.h"
#include "trace/ray_caster.h"

namespace knotlight {

// Photons (as indices into the lists given) that fly along nearly the same direction. Their rays
// spread (or close in, below 0) by `spread` radians per length across the beam: 1/distance for a
// point light.
struct Beam {
  Vec3 direction;  // at the ball's centre, unit
  double spread = 0.0;
  std::vector<std::size_t> members;
};

// The beams among photons with unit directions and offsets (position - centre of the ball); each
// holds at least a tenth of all. What belongs to none, such as light from a sky, is in `others`.
struct Beams {
  std::vector<Beam> beams;
  std::vector<std::size_t> others;
};
Beams find_beams(const std::vector<Vec3>& directions, const std::vector<Vec3>& offsets);

// int K(|u|/r) E(x + u)/E(x) dV over the part of the ball that lies inside the object, length^3,
// where E is the irradiance across the beam: it falls off as exp(-sigma_t s) with the way s inside
// the object (all of it for index-matched objects, which light passes straight: `straight`; else
// since it last met the surface), and as its rays spread. The interactions of a beam per volume at
// x are their number, weighted with K, over this: the estimate with the least variance, and free of
// bias but for changes of the beam before it entered. Summed over lines along the beam, to
// rounding along each.
double beam_mass(const Vec3& x, const Beam& beam, double r, RadialKernel kernel, double sigma_t,
                 bool straight, const RayCaster& caster, std::uint32_t object);

}  // namespace knotlight
