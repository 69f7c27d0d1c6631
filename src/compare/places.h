// Where source models are compared: what the camera sees, points spread over the surface, lines
// into an object, a slice through it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "photon/flux_grid.h"
#include "pipeline/sample_points.h"
#include "pipeline/scene_setup.h"

namespace knotlight {

// The middle of each pixel where the camera sees a translucent object, by object.
struct SeenSurface {
  int width = 0, height = 0;
  struct Part {
    std::vector<std::size_t> pixels;  // row by row from the top
    SurfaceSamples surface;           // one column per pixel
  };
  std::vector<Part> parts;  // one per translucent object

  std::size_t pixels() const;
  // The object (in `parts`) that fills most pixels.
  std::size_t most_seen() const;
};
SeenSurface see_surface(const PreparedScene& prepared);

// A straight line into an object from a point of its surface along the inward normal.
struct InwardLine {
  std::string name;    // what is special about its start
  Vec3 start, inward;  // inward: unit
  double length;       // to the far side, or as far as light gets
  double entered;      // light that enters at the start, channel 0, W/length^2
};

// Three lines: from the most brightly lit place, from one lit as half of the light is, and from the
// shade. Same lines for the same scene and seed.
std::array<InwardLine, 3> choose_lines(const PreparedScene& prepared, std::uint32_t object,
                                       std::uint64_t seed);

// Cubic cells around the object in which photons are counted: a fraction of a transport mean free
// path in channel 0, larger where there would be too many.
FluxGrid truth_grid(const Object& object);

// One layer of square cells through the point, across the axis that points most to the camera.
struct Slice {
  FluxGrid grid;
  int right = 0, down = 2, across = 1;  // axes of the picture; down runs towards smaller values
};
Slice choose_slice(const Object& object, const Camera& camera, const Vec3& through);

}  // namespace knotlight
