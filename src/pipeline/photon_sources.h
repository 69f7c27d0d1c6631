// The incident light of one object as point charges of the boundary solvers: every volume photon is
// a source of the diffusion equation of known strength, no density is ever estimated.
#pragma once

#include "bkm/point_sources.h"
#include "pipeline/channel_problem.h"

namespace knotlight {

// Charges q of -lap U_d + lambda^2 U_d = sum q delta, W/(length sr), of half 0 or 1 of the light
// (each an estimate of all of it): of volume photons with every model, and of the points below the
// surface with irradiance_sampling. Not in it: what the object emits, which is not made of points,
// and the Robin data of boundary_flux. The Robin condition that goes with the charges has
// right-hand side 0: with g != 0 its part is taken by the ends of flights, which are charges on the
// surface.
//
// Each charge has the plane tangent to the surface at its nearest point, and as many charges of its
// Robin image as stay clear of the body's surface (tangent_planes.h).
PointSources photon_sources(const ChannelProblem& problem, int half);

}  // namespace knotlight
