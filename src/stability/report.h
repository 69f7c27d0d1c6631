// What `stability` shows and writes.
#pragma once

#include <string>

#include "stability/stability.h"

namespace knotlight {

// One sentence: how many runs of scenes there were and how many broke the rule.
std::string stability_verdict(const Stability& stability);

// One line per run of a scene, then the verdict.
std::string stability_text(const Stability& stability);

// One line per trial; columns: docs/results/stability.md. No seconds, so the same bits every time.
std::string trials_csv(const Stability& stability);
std::string scenes_csv(const Stability& stability);

// Writes stability.csv, stability-scenes.csv, stability-*.svg and the page stability.html that
// holds all of it to the folder, which must exist; everything is drawn before the first file is
// written. Throws std::runtime_error if gnuplot is missing.
void write_stability(const Stability& stability, const std::string& folder);

}  // namespace knotlight
