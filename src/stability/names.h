// The words of the scene file for the choices that are charted.
#pragma once

#include <string>

#include "core/bkm_choices.h"

namespace knotlight {

std::string name_of(DenseMethod method);
std::string name_of(RadialKind kind);

}  // namespace knotlight
