// The bodies of the thesis's experiments, a cube and a ball under one lamp, what it makes of them,
// and what is right.
//
// The thesis gives the cube, its lamp [V09 fig. 7.3] and g = 0.85 [V09 fig. 7.13], but no other
// coefficient. Those here are such that lambda^2 = 6.3, what the tolerance of its table 7.1
// (2.357e-9 = 1296 x 2^-52 x norm, and a norm of 1296 lambda^2 for wide Gaussians) amounts to, and
// that the cube is ten transport mean free paths wide: a tenth of it is one, where the thesis's
// lamps come to lie outside, as it reports.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bkm/thesis_solver.h"
#include "core/medium.h"
#include "core/shape.h"
#include "pipeline/channel_problem.h"
#include "scene/scene.h"

namespace knotlight {

enum class LitShape { cube, ball };  // [0, 2]^3, lit from (-1, -1, 1); |x| < 1, from (-3, 0, 0)

// sigma_a = 0.0421, sigma_s = 3.055 per length, both times `scale`.
constexpr double usual_scale = 10.0, usual_g = 0.85;
Medium thesis_medium(double scale = usual_scale, double g = usual_g);

struct LitBody {
  LitShape which = LitShape::cube;
  Medium medium;

  Shape shape() const;
  PointLight lamp() const;            // intensity 1
  double depth(const Vec3& x) const;  // from the nearest surface, < 0 outside, length
  // E of the lamp on the surface of these convex bodies, W/length^2.
  double irradiance(const SurfacePoint& at) const;
};

// Knots as the thesis has them: n x n cell centres on each face of the cube (its MATLAB program);
// n x n strata in each of the twelve triangles of its faces, in (z, phi) of the sphere (its program
// with PBRT), at their centres or anywhere in them.
SurfaceSamples cube_face_knots(int n, double lo = 0.0);
SurfaceSamples cube_triangle_knots(int n);
SurfaceSamples ball_knots(int n, bool jitter, std::uint64_t seed);

struct ThesisSetup {
  SurfaceSamples knots;
  std::vector<double> layers;  // of further interior knots, depths in transport mean free paths
  Points more = Points(3, 0);  // and more of them
  // 3/2 and Gaussians with c = 500: what most of its pictures have.
  BkmThesisOptions options{};
};
ThesisSetup usual_setup(const LitBody& body, bool quick, std::uint64_t seed);

// The thesis's way [V09 6.22-6.24]: the value exp(-sigma_t l) E / (4 pi) of an isotropic lamp at
// the depth l = 1/sigma_tr below each boundary knot, inside the body or not; 0 at all other knots;
// no boundary data.
struct ThesisProblem {
  BkmThesisProblem problem;
  Eigen::VectorXd f, g;
  double outside = 0.0;  // share of the lamps that are not in the body
};
ThesisProblem thesis_problem(const LitBody& body, const ThesisSetup& setup);

struct ThesisAnswer {
  BkmField field;
  int particular_rank = 0, homogeneous_rank = 0;
  double particular_condition = 0.0, homogeneous_condition = 0.0;
  double seconds = 0.0;  // matrices, decompositions, coefficients; processor time
};
ThesisAnswer thesis_answer(const ThesisProblem& problem, const BkmThesisOptions& options);

// The least relative L2 difference of s u and `truth` over all s >= 0: the thesis's source has no
// unit, so it is given the best one. 1: no better than nothing.
double shape_error(const Eigen::VectorXd& u, const Eigen::VectorXd& truth);

// The body solved by the program: P1, Marshak's condition, photon map.
struct RightAnswer {
  Points positions;       // random ones on the surface
  Eigen::VectorXd truth;  // U_d there, by a fine grid and many photons
  FieldValues truth_at;
  double truth_uncertainty = 0.0;  // its own estimate, relative
  FieldValues ours_at;             // by patches (lbkm), other photons, everything else by default
  double error = 0.0;              // of ours at the positions, relative L2, no factor
  double error_estimate = 0.0;     // its own
  double seconds = 0.0;            // of ours, processor time
};

// Each solved once, when first asked for.
class LitBodies {
 public:
  LitBodies(bool quick, RunContext& run) : quick_(quick), run_(run) {}
  const RightAnswer& right(const LitBody& body);

 private:
  RightAnswer solve(const LitBody& body) const;

  bool quick_;
  RunContext& run_;
  std::map<std::string, RightAnswer> solved_;
};

}  // namespace knotlight
