// What is charted: lines of settings, each from coarse to fine.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "rivals/dipole_kernel.h"
#include "scene/scene.h"

namespace knotlight {

// Who makes the picture: the scene's solver, the dipole (src/rivals), or path tracing.
enum class Maker { solver, dipole, reference };

// One setting to be measured.
struct Contender {
  std::string line;     // settings that differ only in how finely they are worked out
  std::string setting;  // which of the line, in words
  int level = 0;        // 0: the coarsest; finer ones may cost four times as much
  Maker maker = Maker::solver;
  SolverSettings solver = {};             // Maker::solver
  std::uint64_t samples = 0;              // per pixel, Maker::reference
  double entries = 0.0;                   // per square of a transport mean free path, Maker::dipole
  DipoleForm form = DipoleForm::classic;  // Maker::dipole

  std::string name() const { return line + "; " + setting; }
};

// What the scene has the solver do if it is aimed at this tolerance and nothing else is changed.
using SettingsOfTolerance = std::function<SolverSettings(double tolerance)>;

// Every line for a scene: what the program chooses by itself, to which all else is compared, then
// the coarsest settings of all other lines, and so on. levels: how many, 1..6. A
// setting is the scene's own but for what its line is about: source, method, exitance, diffusion,
// knots, photons, tolerance, precision.
std::vector<Contender> contenders(const Scene& scene, const SettingsOfTolerance& chosen,
                                  int levels);

// The line that shows what `tolerance` chooses by itself.
inline constexpr const char* default_line = "default settings";
// The same for its field, which is judged where all of it is the equation's (P1).
inline constexpr const char* our_field_line = "grid, p1";
// The rivals' lines.
inline constexpr const char* dipole_line = "dipole";
inline constexpr const char* better_dipole_line = "dipole, better form";
inline constexpr const char* path_tracing_line = "path tracing";
inline constexpr const char* finite_elements_line = "finite elements";  // of another program

}  // namespace knotlight
