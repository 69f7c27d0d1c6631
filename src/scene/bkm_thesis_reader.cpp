#include <array>
#include <cctype>

#include "scene/nearest_name.h"
#include "scene/scene_parts.h"

namespace knotlight {
namespace {

constexpr std::array<Choice<KnotLayout>, 4> knot_layouts{{
    {"vertices", KnotLayout::vertices},
    {"stratified", KnotLayout::stratified},
    {"jittered", KnotLayout::jittered},
    {"blue_noise", KnotLayout::blue_noise},
}};
constexpr std::array<Choice<InteriorLayout>, 5> interior_layouts{{
    {"none", InteriorLayout::none},
    {"one_layer", InteriorLayout::one_layer},
    {"near_layers", InteriorLayout::near_layers},
    {"two_layers", InteriorLayout::two_layers},
    {"grid", InteriorLayout::grid},
}};
constexpr std::array<Choice<RadialKind>, 10> radial_functions{{
    {"linear", RadialKind::linear},
    {"cubic", RadialKind::cubic},
    {"thin_plate", RadialKind::thin_plate},
    {"gaussian", RadialKind::gaussian},
    {"multiquadric", RadialKind::multiquadric},
    {"inverse_multiquadric", RadialKind::inverse_multiquadric},
    {"compact_c0", RadialKind::compact_c0},
    {"compact_c2", RadialKind::compact_c2},
    {"compact_c4", RadialKind::compact_c4},
    {"nonsingular", RadialKind::nonsingular},
}};
constexpr std::array<Choice<DenseMethod>, 5> dense_solvers{{
    {"svd", DenseMethod::svd},
    {"qr", DenseMethod::qr},
    {"lu", DenseMethod::lu},
    {"tikhonov_gcv", DenseMethod::tikhonov_gcv},
    {"tikhonov_l_curve", DenseMethod::tikhonov_l_curve},
}};
constexpr std::array<Choice<DistancePrecision>, 2> precisions{{
    {"double", DistancePrecision::double_precision},
    {"float", DistancePrecision::single_precision},
}};

// Radial functions a millionth or a million knot spacings wide are a slip, not a choice.
constexpr Range knot_spacings{1e-6, 1e6};
// Beyond, (1 + r^2)^(b/2) over a body of some widths leaves no digits.
constexpr Range exponents{0.0, 20.0, true, false};
constexpr std::size_t highest_order = 4;  // the kernels go no further (bkm/kernel_batch.h)

// A number, or the word leave_one_out.
void read_shape_parameter(const YamlNode& node, BkmThesisSettings& settings) {
  const std::string word = "leave_one_out";
  if (!has_width(settings.radial_function))
    fail(node, "is not used by this radial_function, expected none");
  if (node.kind == YamlNode::Kind::scalar && !node.text.empty() &&
      std::isalpha(static_cast<unsigned char>(node.text.front())) != 0) {
    if (node.text != word)
      fail(node, "is " + quote(node.text) + did_you_mean(node.text, {word}) +
                     ", expected a number or leave_one_out");
    settings.leave_one_out = true;
    return;
  }
  settings.shape_parameter = read_number(node, knot_spacings);
}

}  // namespace

const std::vector<std::string> bkm_thesis_keys{
    "jitter",          "knot_layout",  "interior_knots",    "radial_function",
    "radial_exponent", "radial_order", "shape_parameter",   "basis_order",
    "dense_solver",    "svd_cut",      "distance_precision"};

BkmThesisSettings read_bkm_thesis(const YamlNode& solver) {
  BkmThesisSettings settings;
  if (const auto* key = solver.find("knot_layout")) {
    settings.knot_layout = read_choice(*key, knot_layouts);
  }
  if (const auto* key = solver.find("jitter")) {
    if (solver.find("knot_layout") != nullptr)
      fail(*key, "says again what knot_layout says, expected one of the two");
    settings.knot_layout = read_bool(*key) ? KnotLayout::jittered : KnotLayout::stratified;
  }
  if (const auto* key = solver.find("interior_knots")) {
    settings.interior_knots = read_choice(*key, interior_layouts);
  }
  if (const auto* key = solver.find("radial_function")) {
    settings.radial_function = read_choice(*key, radial_functions);
  }
  if (const auto* key = solver.find("radial_exponent")) {
    if (settings.radial_function != RadialKind::multiquadric &&
        settings.radial_function != RadialKind::inverse_multiquadric)
      fail(*key,
           "belongs to the multiquadrics, expected radial_function multiquadric or "
           "inverse_multiquadric with it");
    settings.radial_exponent = read_number(*key, exponents);
  }
  if (const auto* key = solver.find("radial_order")) {
    if (settings.radial_function != RadialKind::nonsingular)
      fail(*key,
           "belongs to the non-singular solutions, expected radial_function nonsingular with "
           "it");
    settings.radial_order = static_cast<int>(read_count(*key, 1, highest_order));
  }
  if (const auto* key = solver.find("shape_parameter")) read_shape_parameter(*key, settings);
  if (const auto* key = solver.find("basis_order")) {
    settings.basis_order = static_cast<int>(read_count(*key, 0, highest_order));
  }
  if (const auto* key = solver.find("dense_solver")) {
    settings.dense_solver = read_choice(*key, dense_solvers);
  }
  if (const auto* key = solver.find("svd_cut")) {
    if (settings.dense_solver != DenseMethod::svd && settings.dense_solver != DenseMethod::qr)
      fail(*key, "is not used by this dense_solver, expected svd or qr with it");
    settings.svd_cut = read_number(*key, between_0_and_1);
  }
  if (const auto* key = solver.find("distance_precision")) {
    settings.distance_precision = read_choice(*key, precisions);
  }
  return settings;
}

}  // namespace knotlight
