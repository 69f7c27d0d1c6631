// What is measured: scenes whose answer is known.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/shape.h"

namespace knotlight {

// Points on the surface, and U_d there to 0.2 % or better.
struct Reference {
  Points positions;     // 3 x N
  Eigen::VectorXd U_d;  // N, W/(length^2 sr)
};

struct BarsCase {
  std::string name;
  std::string scene;                   // file in tests/bars/scenes
  std::vector<std::string> overrides;  // of its keys
  std::function<void()> make_mesh;     // writes what the scene names; empty = nothing to
  std::function<Reference()> reference;
  double bar;  // relative L2 error aimed at
};

// All of them. Spheres: the series of sphere_beam_p1. Others: tests/bars/NAME.csv, made by
// tetrahedral finite elements of second order (docs/results/bars.md tells how, and their error).
std::vector<BarsCase> bars_cases();

// The file that a scene's generated mesh is kept in; its folder is made.
std::string made_mesh(const std::string& name);

// Rows x,y,z,nx,ny,nz,U after a header. Throws std::runtime_error.
Reference read_reference(const std::string& path);

}  // namespace knotlight
