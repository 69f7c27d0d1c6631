// The whole program on scenes that ask for trouble.
//
// The rule: no method may crash (any exception but one that refuses the scene as wrong input),
// take longer than `longest_seconds`, give a value that is not finite and call it trusted, or be
// wrong and call it trusted: relative L2 error of U_d over the surface above 3 times the tolerance,
// which is where the program itself draws the line, plus what the reference may be off.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace knotlight {

constexpr double longest_seconds = 120.0;  // of one thread; the slowest needs a fifth of it

// U_d on the surface, W/(length^2 sr), from elsewhere.
struct SurfaceTruth {
  Points positions;  // 3 x N
  Eigen::VectorXd U_d;
  double uncertainty = 0.0;  // relative L2
  std::string source;        // in words
};

struct ExtremeScene {
  enum class Truth { ball_under_beam, lamp_in_ball, slab, fine_grid };
  std::string name;
  std::string trouble;  // what is extreme about it
  Scene scene;
  Truth truth = Truth::fine_grid;
};

std::vector<ExtremeScene> extreme_scenes(bool quick);
SurfaceTruth truth_of(const ExtremeScene& extreme, std::uint64_t seed);

struct ExtremeTrial {
  std::string scene, method;
  int exit_code = 0;                  // what the program would end with
  std::vector<std::string> failures;  // why, if not 0
  bool finite = false;                // U_d at every point of the surface that was asked for
  double error_estimate = 0.0;
  double error = 0.0;    // true one; not-a-number if there is no solution
  double allowed = 0.0;  // error that may be trusted
  double seconds = 0.0;

  bool too_slow() const { return seconds > longest_seconds; }
  // Written so that not-a-number is wrong.
  bool wrong() const { return exit_code == 0 && !(finite && error <= allowed); }
  bool crashed() const { return exit_code == 1; }
  bool breaks_the_rule() const { return too_slow() || wrong() || crashed(); }
};

// On one thread.
ExtremeTrial try_extreme(const ExtremeScene& extreme, Method method, const SurfaceTruth& truth,
                         std::uint64_t seed);

}  // namespace knotlight
