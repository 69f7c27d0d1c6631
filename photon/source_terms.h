// Right-hand sides of the diffusion problem from a volume photon map:
//   lap U_d - lambda^2 U_d = f inside,   U_d + k dU_d/dn = g_robin on the boundary, n outward.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/medium.h"
#include "core/parallel.h"
#include "photon/photon_map.h"
#include "scene/scene.h"

namespace knotlight {

struct SourceTermOptions {
  EstimateOptions estimate;
  Boundary boundary = Boundary::milne;
  // identity: div Q_ri = -4 pi g sigma_s sigma_t U_ri, known; f needs no derivative.
  // differentiated: div Q_ri by differences of the estimated Q_ri, the naive way; its noise grows
  // as 1/difference_step, its bias as the square of the step.
  Divergence divergence = Divergence::identity;
  double difference_step = 0.25;  // in mean free paths 1/sigma_t; differentiated only
};

struct SourceTerms {
  Eigen::VectorXd f;     // N + M: boundary points first, then interior; W/(length^4 sr)
  Eigen::VectorXd g;     // N: Robin data at the boundary points, W/(length^2 sr)
  Eigen::VectorXd U_ri;  // N + M, W/(length^2 sr)
  // Mean over all points of the standard error of U_ri over U_ri, from the photons in each ball;
  // infinite if a ball was empty, 0 for an empty map.
  double mean_relative_error = 0.0;
};

// f at one point inside the object or on its surface. Differentiated: central differences; closer
// to the surface than the step they are taken about the point one step inside.
double source_term(const Vec3& x, const VolumePhotonMap& map, const Medium& medium,
                   const SourceTermOptions& options, const RayCaster& caster, std::uint32_t object);

// All right-hand sides of one object. boundary_points, boundary_normals (outward unit): 3 x N;
// interior_points: 3 x M. Same bits for any number of workers.
SourceTerms source_terms(const Points& boundary_points, const Points& boundary_normals,
                         const Points& interior_points, const VolumePhotonMap& map,
                         const Medium& medium, const SourceTermOptions& options,
                         const RayCaster& caster, std::uint32_t object, const Workers& workers);

}  // namespace knotlight
