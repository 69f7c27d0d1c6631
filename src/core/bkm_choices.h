// What a scene may choose of the boundary knot method: the words that the scene reader knows and
// the method's stages act on. What each means: docs/scene-format.md, section solver.
#pragma once

namespace knotlight {

// Radial functions of dual reciprocity: the nine of [V09 tab. 5.1] and the non-singular solutions
// of higher order [V09 6.8].
enum class RadialKind {
  linear,
  cubic,
  thin_plate,
  gaussian,
  multiquadric,
  inverse_multiquadric,
  compact_c0,
  compact_c2,
  compact_c4,
  nonsingular,
};

// The non-singular solutions know lambda, and of r and r^3 another unit of length only changes the
// size: these have no width to choose.
constexpr bool has_width(RadialKind kind) {
  return kind != RadialKind::linear && kind != RadialKind::cubic && kind != RadialKind::nonsingular;
}

// How the dense systems are solved.
enum class DenseMethod { svd, qr, lu, tikhonov_gcv, tikhonov_l_curve };

// Where boundary knots lie: at vertices, at the centres or random points of strata of equal area,
// or spread as far from each other as can be.
enum class KnotLayout { vertices, stratified, jittered, blue_noise };

// Knots of dual reciprocity inside the body: none, layers at these depths in transport mean free
// paths (3/2; 1/2 and 3/2; 1 and 3/2), or a cubic lattice.
enum class InteriorLayout { none, one_layer, near_layers, two_layers, grid };

// Arithmetic of distances between knots. single_precision is what the thesis's first program had,
// and lost its solution to [V09 fig. 7.3].
enum class DistancePrecision { double_precision, single_precision };

}  // namespace knotlight
