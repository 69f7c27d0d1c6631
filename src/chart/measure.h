// One setting on one scene: runs it and compares.
#pragma once

#include "chart/contender.h"
#include "chart/measurement.h"
#include "chart/yardstick.h"

namespace knotlight {

// Runs it `repeats` times with seeds of their own; costs are means, errors root mean squares over
// the repeats. With one repeat noise and numerical error are not told apart: both stay unknown.
Measurement measure(const Contender& contender, PreparedScene& prepared, const Yardstick& by,
                    int repeats, const RunContext& run);

}  // namespace knotlight
