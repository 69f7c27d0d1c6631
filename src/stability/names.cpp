#include "stability/names.h"

namespace knotlight {

std::string name_of(DenseMethod method) {
  switch (method) {
    case DenseMethod::svd:
      return "svd";
    case DenseMethod::qr:
      return "qr";
    case DenseMethod::lu:
      return "lu";
    case DenseMethod::tikhonov_gcv:
      return "tikhonov_gcv";
    case DenseMethod::tikhonov_l_curve:
      return "tikhonov_l_curve";
  }
  return "";
}

std::string name_of(RadialKind kind) {
  switch (kind) {
    case RadialKind::linear:
      return "linear";
    case RadialKind::cubic:
      return "cubic";
    case RadialKind::thin_plate:
      return "thin_plate";
    case RadialKind::gaussian:
      return "gaussian";
    case RadialKind::multiquadric:
      return "multiquadric";
    case RadialKind::inverse_multiquadric:
      return "inverse_multiquadric";
    case RadialKind::compact_c0:
      return "compact_c0";
    case RadialKind::compact_c2:
      return "compact_c2";
    case RadialKind::compact_c4:
      return "compact_c4";
    case RadialKind::nonsingular:
      return "nonsingular";
  }
  return "";
}

}  // namespace knotlight
