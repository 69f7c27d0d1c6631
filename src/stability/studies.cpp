#include "stability/studies.h"

#include <cmath>
#include <memory>
#include <utility>

#include "stability/methods.h"
#include "stability/names.h"

namespace knotlight {
namespace {

constexpr double usual_albedo = 0.99;   // reduced
constexpr double usual_lambda_R = 3.0;  // 17 transport mean free paths from the middle out
constexpr double usual_distance = 3.0;  // of exterior sources, in knot spacings
constexpr int usual_degree = 4;
constexpr std::size_t usual_knots = 400;
constexpr double pinv_rule = -1.0;
constexpr double usual_width = 8.0;  // of radial functions, in knot spacings

const std::vector<double> noises{0.0, 1e-6, 1e-3};

// The parts of a study that every line shares.
struct Setting {
  std::string study, method, parameter;
  double value;
};

using Try = std::function<std::vector<Outcome>(const BoundaryCase&)>;

std::vector<Trial> lines(const Setting& setting, const BoundaryCase& c, double lambda_R,
                         double albedo, const Try& run) {
  std::vector<Trial> trials;
  const std::vector<Outcome> outcomes = run(c);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    trials.push_back({setting.study, c.body->name, setting.method,
                      c.fields[i / c.noises.size()].name, lambda_R, albedo, setting.parameter,
                      setting.value, c.noises[i % c.noises.size()], outcomes[i]});
  return trials;
}

class Studies {
 public:
  Studies(bool quick, std::uint64_t seed)
      : quick_(quick),
        seed_(seed),
        bodies_{std::make_shared<const Body>(unit_ball()),
                std::make_shared<const Body>(thin_torus())} {}

  std::vector<StudyJob> jobs() {
    for (const auto& body : bodies_) {
      resolution(body);
      distance(body);
      degree(body);
      dense_solvers(body);
    }
    albedo(bodies_[0]);
    dual_reciprocity(bodies_[0]);
    return std::move(jobs_);
  }

 private:
  using BodyPointer = std::shared_ptr<const Body>;

  // In a quick run the first, the middle and the last.
  std::vector<double> some(std::vector<double> values) const {
    if (!quick_ || values.size() <= 3) return values;
    return {values.front(), values[values.size() / 2], values.back()};
  }

  void add(const BodyPointer& body, const Setting& setting, double lambda_R, double albedo,
           Try run) {
    jobs_.push_back([=, seed = seed_, run = std::move(run)] {
      return lines(setting, source_case(*body, lambda_R, albedo, noises, seed), lambda_R, albedo,
                   run);
    });
  }

  std::vector<double> lambda_Rs() const {
    return some({0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0});
  }

  // Every method, lambda R against what it can spend.
  void resolution(const BodyPointer& body) {
    for (const double lambda_R : lambda_Rs()) {
      for (const double n : quick_ ? std::vector<double>{100.0} : knot_counts_) {
        const auto count = static_cast<std::size_t>(n);
        add(body, {"resolution", "bkm_thesis", "knots", n}, lambda_R, usual_albedo,
            [=](const auto& c) { return try_thesis(c, count, DenseMethod::svd, pinv_rule); });
        add(body, {"resolution", "bkm", "knots", n}, lambda_R, usual_albedo,
            [=](const auto& c) { return try_bkm(c, count); });
        add(body, {"resolution", "mfs", "knots", n}, lambda_R, usual_albedo,
            [=](const auto& c) { return try_mfs(c, count, usual_distance); });
      }
      for (const double parts : quick_ ? std::vector<double>{2.0} : patches_)
        add(body, {"resolution", "lbkm", "patches across", parts}, lambda_R, usual_albedo,
            [=, R = body->half_extent](const auto& c) {
              return try_lbkm(c, 2.0 * R / parts * (1.0 + rounding), usual_degree);
            });
      for (const double cells : quick_ ? std::vector<double>{16.0} : cells_)
        add(body, {"resolution", "grid", "cells across", cells}, lambda_R, usual_albedo,
            [=, R = body->half_extent](const auto& c) { return try_grid(c, 2.0 * R / cells); });
    }
  }

  // How far outside the sources stand.
  void distance(const BodyPointer& body) {
    for (const double lambda_R : {0.3, usual_lambda_R, 30.0})
      for (const double d : some({0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0}))
        add(body, {"distance", "mfs", "distance in knot spacings", d}, lambda_R, usual_albedo,
            [=, n = knots()](const auto& c) { return try_mfs(c, n, d); });
  }

  // Waves in a patch.
  void degree(const BodyPointer& body) {
    for (const double parts : quick_ ? std::vector<double>{2.0} : patches_)
      for (const double degree : some({1.0, 2.0, 3.0, 4.0, 5.0, 6.0}))
        add(body, {"degree", fmt_parts(parts), "degree", degree}, usual_lambda_R, usual_albedo,
            [=, R = body->half_extent](const auto& c) {
              return try_lbkm(c, 2.0 * R / parts * (1.0 + rounding), static_cast<int>(degree));
            });
  }

  // The thesis's square system: where to cut, and what else there is.
  void dense_solvers(const BodyPointer& body) {
    for (const double lambda_R : {usual_lambda_R, 30.0})
      for (const double cut : some({1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8,
                                    1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}))
        add(body, {"cut", "svd", "relative cut", cut}, lambda_R, usual_albedo,
            [=, n = knots()](const auto& c) { return try_thesis(c, n, DenseMethod::svd, cut); });
    for (const double lambda_R : lambda_Rs())
      for (const DenseMethod method : {DenseMethod::lu, DenseMethod::qr, DenseMethod::svd,
                                       DenseMethod::tikhonov_gcv, DenseMethod::tikhonov_l_curve})
        add(body, {"dense", name_of(method), "lambda R", lambda_R}, lambda_R, usual_albedo,
            [=, n = knots()](const auto& c) { return try_thesis(c, n, method, pinv_rule); });
  }

  // Twenty transport mean free paths from the middle out, absorbing more and more.
  void albedo(const BodyPointer& body) {
    constexpr double sigma_tr_R = 20.0;
    for (const double absorbed : some({0.5, 0.2, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5})) {
      const double a = 1.0 - absorbed;
      const double lambda_R = sigma_tr_R * std::sqrt(3.0 * absorbed);
      const std::size_t n = knots();
      const auto add_line = [&](const std::string& method, Try run) {
        add(body, {"albedo", method, "1 - albedo", absorbed}, lambda_R, a, std::move(run));
      };
      add_line("bkm_thesis",
               [=](const auto& c) { return try_thesis(c, n, DenseMethod::svd, pinv_rule); });
      add_line("bkm", [=](const auto& c) { return try_bkm(c, n); });
      add_line("mfs", [=](const auto& c) { return try_mfs(c, n, usual_distance); });
      const double parts = quick_ ? 2.0 : 4.0;
      add_line("lbkm", [=](const auto& c) {
        return try_lbkm(c, 2.0 / parts * (1.0 + rounding), usual_degree);
      });
      const double cells = quick_ ? 16.0 : 48.0;
      add_line("grid", [=](const auto& c) { return try_grid(c, 2.0 / cells); });
    }
  }

  // Sources of a layer 1/s thick, 2 to 50 of which fill the radius, at albedo 0.99.
  void dual_reciprocity(const BodyPointer& body) {
    for (const double s : some({2.0, 5.0, 10.0, 20.0, 50.0})) {
      for (const double width : some({0.5, 1.0, 2.0, 4.0, 8.0, 16.0}))
        add_layer(body, {"width", "gaussian", "width in knot spacings", width}, s,
                  RadialKind::gaussian, width);
      for (const RadialKind kind :
           {RadialKind::linear, RadialKind::cubic, RadialKind::thin_plate, RadialKind::gaussian,
            RadialKind::multiquadric, RadialKind::inverse_multiquadric, RadialKind::compact_c0,
            RadialKind::compact_c2, RadialKind::compact_c4, RadialKind::nonsingular})
        add_layer(body, {"radial", name_of(kind), "1/s over R", 1.0 / s}, s, kind, usual_width);
    }
  }

  void add_layer(const BodyPointer& body, const Setting& setting, double s, RadialKind kind,
                 double width) {
    const double lambda_R = s * std::sqrt(3.0 * (1.0 - usual_albedo));
    const std::size_t n = quick_ ? 60 : 200;
    jobs_.push_back([=, seed = seed_] {
      BoundaryCase c = source_case(*body, lambda_R, usual_albedo, noises, seed);
      c.fields = {decaying_layer(body->foot.normal, s)};
      return lines(setting, c, lambda_R, usual_albedo, [=](const BoundaryCase& layer) {
        return try_dual_reciprocity(layer, s, n, kind, width);
      });
    });
  }

  std::size_t knots() const { return quick_ ? 100 : usual_knots; }
  static std::string fmt_parts(double parts) {
    return std::to_string(static_cast<int>(parts)) + " patches across";
  }

  // Patches of exactly the width wanted are not to be halved once more by rounding.
  static constexpr double rounding = 0.01;

  bool quick_;
  std::uint64_t seed_;
  std::vector<BodyPointer> bodies_;
  std::vector<StudyJob> jobs_;
  const std::vector<double> knot_counts_{50.0, 100.0, 200.0, 400.0, 800.0};
  const std::vector<double> patches_{1.0, 2.0, 4.0, 8.0};
  const std::vector<double> cells_{8.0, 16.0, 32.0, 64.0};
};

}  // namespace

std::vector<StudyJob> study_jobs(bool quick, std::uint64_t seed) {
  return Studies(quick, seed).jobs();
}

}  // namespace knotlight
