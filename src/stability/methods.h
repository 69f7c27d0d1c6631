// Every method on an exact boundary value problem, through its own interface: the one file that
// knows them all.
#pragma once

#include "core/bkm_choices.h"
#include "stability/trial.h"

namespace knotlight {

// Each gives one outcome per field and noise, all noises of the first field first, and works on
// the calling thread alone.

// Non-singular solutions about `knots` points, Robin condition there: square, as the thesis has it.
std::vector<Outcome> try_thesis(const BoundaryCase& c, std::size_t knots, DenseMethod method,
                                double cut);
// The same basis, Robin condition at twice as many points, least squares.
std::vector<Outcome> try_bkm(const BoundaryCase& c, std::size_t knots);
// Sources outside, `distance` in knot spacings.
std::vector<Outcome> try_mfs(const BoundaryCase& c, std::size_t knots, double distance);
// Patches no wider than `width`, length.
std::vector<Outcome> try_lbkm(const BoundaryCase& c, double width, int degree);
// Cells of size h, length.
std::vector<Outcome> try_grid(const BoundaryCase& c, double h);

// Dual reciprocity: fields that decay over 1/s have the source (s^2 - lambda^2) u. `knots` on the
// surface and as many at each of the depths 1/s and 3/2 1/s below. width: in knot spacings. Rank
// and condition are those of the particular system; noise is in f and g.
std::vector<Outcome> try_dual_reciprocity(const BoundaryCase& c, double s, std::size_t knots,
                                          RadialKind radial, double width);

}  // namespace knotlight
