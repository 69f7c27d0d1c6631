// The `view` command: a window in which the scene can be turned, lit and changed while it is solved
// and rendered anew. Everything but windows, events and drawing is in src/view.
#pragma once

#include <string>

#include "pipeline/run_options.h"

namespace knotlight {

// Returns when the window is closed. Throws InputError as `render` does for the scene, and
// std::runtime_error if no window can be opened.
void view_scene(const std::string& path, const RunOptions& options);

}  // namespace knotlight
