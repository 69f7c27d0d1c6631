// The incident light of one object as point charges of the boundary solvers: every volume photon is
// a source of the diffusion equation of known strength, no density is ever estimated.
#pragma once

#include "bkm/point_sources.h"
#include "pipeline/channel_problem.h"

namespace knotlight {

// Charges q of -lap U_d + lambda^2 U_d = sum q delta, W/(length sr), of half 0 or 1 of the light
// (each an estimate of all of it), for the models photon_map and irradiance_sampling; with
// boundary_flux those of the light that was scattered before it entered. Without what the object
// emits, which is not made of points, and without the Robin data of boundary_flux. The source of
// flights' ends on the surface (g != 0) stands for the boundary's right-hand side, which is then 0.
//
// Each charge has the plane tangent to the surface at its nearest point. Its Robin image is dropped
// where it would not stay clear of the body: the mirror point and the line behind it.
PointSources photon_sources(const ChannelProblem& problem, int half);

}  // namespace knotlight
