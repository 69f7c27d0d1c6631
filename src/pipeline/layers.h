// Layers of a picture beside its light: what is where, and what the solver knows there
// (docs/layers.md).
#pragma once

#include <string>
#include <vector>

#include "core/image_io.h"
#include "pipeline/run_options.h"
#include "pipeline/scene_setup.h"
#include "pipeline/solve_scene.h"
#include "render/picture.h"
#include "render/shading.h"

namespace knotlight {

// The names in "depth,normal", once each, in the order of docs/layers.md; "all" stands for all.
// Throws InputError for an unknown name.
std::vector<std::string> chosen_layers(const std::string& list);

// Whether a picture of this name can hold layers: .exr.
bool holds_layers(const std::string& path);

struct PictureLayers {
  std::vector<Layer> channels;        // name, or name.R, .G, .B of light, or name.X, .Y, .Z
  Metadata metadata;                  // meaning and unit of each
  std::vector<std::string> warnings;  // layers that were left out and why, one line each
};

// The layers of these names (chosen_layers), one sample per pixel, at its centre. surfaces: those
// of the solution; parts: those of the picture, which become layers as they are. Same bits for any
// number of workers and whatever other layers are asked for.
PictureLayers picture_layers(const std::vector<std::string>& names, const PreparedScene& prepared,
                             const SolvedScene& solved, const GlowingSurfaces& surfaces,
                             const Shading& shading, const PictureParts& parts, RunContext& run);

// The picture as channels R, G, B followed by the layers, to an .exr file. Throws like write_layers
// and for pixels that are not finite.
void write_picture_with_layers(const std::string& path, const Image& image,
                               const PictureLayers& layers, Metadata metadata);

}  // namespace knotlight
