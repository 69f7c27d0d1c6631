// f and the Robin data against the closed form of a slab lit at right angles.
#include "photon/source_terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "photon/photon_scenes.h"

namespace knotlight {
namespace {

using std::numbers::pi;
using testing_scenes::caster_of;
using testing_scenes::parallel_light;
using testing_scenes::scene_of;
using testing_scenes::trace;
using testing_scenes::translucent;
using Orders = TracerOptions::Orders;

// 64 points: Student's t with 63 degrees of freedom exceeds 5.5 with probability 7e-7.
constexpr double student_sigmas = 5.5;

void expect_mean(const Eigen::VectorXd& x, double exact, double allowed_bias) {
  double mean = 0.0;
  double squares = 0.0;
  const double n = static_cast<double>(x.size());
  for (const double v : x) mean += v / n;
  for (const double v : x) squares += (v - mean) * (v - mean);
  EXPECT_NEAR(mean, exact, student_sigmas * std::sqrt(squares / (n - 1.0) / n) + allowed_bias);
}

class SourceTermsOfASlab : public ::testing::Test {
 protected:
  static constexpr double E = 3.0;
  Medium medium_{0.2, 1.8, 0.8, 1.0, 0.4};
  Scene scene_ = scene_of({parallel_light(-Vec3::UnitZ(), E)},
                          {translucent(box_mesh(Vec3(-4, -4, -3), Vec3(4, 4, 0)), medium_)});
  std::unique_ptr<RayCaster> caster_ = caster_of(scene_);
  VolumePhotonMap map_{trace(scene_, Orders::first, 600'000, true).photons[0], medium_};
  DiffusionCoefficients c_ = diffusion_coefficients(medium_, Boundary::milne);

  static Points grid(double z) {
    Points p(3, 64);
    for (int i = 0; i < 64; ++i) p.col(i) = Vec3(0.7 * (i % 8 - 3.5), 0.7 * (i / 8 - 3.5), z);
    return p;
  }
  SourceTerms terms(const SourceTermOptions& options, double depth, int threads = 2) const {
    const Points normals = Vec3::UnitZ().replicate(1, 64);
    return source_terms(grid(0.0), normals, grid(-depth), map_, medium_, options, *caster_, 0,
                        Workers(threads));
  }
  double exact_U_ri(double z) const { return E * std::exp(-2.0 * z) / (4.0 * pi); }
  // -3 sigma_s (sigma_tr + g sigma_t) U_ri - (3 sigma_tr/4pi) E, written out.
  double exact_f(double z) const {
    return -3.0 * 1.8 * (0.56 + 1.6) * exact_U_ri(z) - 3.0 * 0.56 / (4.0 * pi) * 0.4;
  }
};

// Allowed: 1 % for the volume of the ball, as in photon_map_test.cpp.
TEST_F(SourceTermsOfASlab, IdentityForm) {
  const SourceTerms t = terms({}, 0.5);
  ASSERT_EQ(t.f.size(), 128);
  ASSERT_EQ(t.g.size(), 64);
  ASSERT_EQ(t.U_ri.size(), 128);
  expect_mean(t.U_ri.head(64), exact_U_ri(0.0), 0.01 * exact_U_ri(0.0));
  expect_mean(t.f.head(64), exact_f(0.0), 0.01 * std::abs(exact_f(0.0)));
  expect_mean(t.f.tail(64), exact_f(0.5), 0.01 * std::abs(exact_f(0.5)));
  // Q_ri.n = -g sigma_s E on the lit face.
  const double g = c_.A / (2.0 * pi * 0.56) * (-0.8 * 1.8 * E);
  expect_mean(t.g, g, 0.01 * std::abs(g));
  EXPECT_GT(t.mean_relative_error, 0.0);
  EXPECT_LT(t.mean_relative_error, 0.3);
}

// At a depth of one mean free path: differences over 2 h with sigma_t h = 1/4 overestimate the
// slope by (1/4)^2/6 = 1 %, balls of up to 1/2 mean free path the values by (1/2)^2/10 = 2.5 %.
TEST_F(SourceTermsOfASlab, DifferentiatedFormInside) {
  SourceTermOptions options;
  options.divergence = Divergence::differentiated;
  options.estimate = {200, 0.5};
  const SourceTerms t = terms(options, 0.5);
  expect_mean(t.f.tail(64), exact_f(0.5), 0.035 * std::abs(exact_f(0.5)));
  // And it is the noisier one by far: that is its point.
  const SourceTerms identity = terms({{200, 0.5}}, 0.5);
  const auto spread = [](const Eigen::VectorXd& x) {
    double mean = 0.0;
    double squares = 0.0;
    for (const double v : x) mean += v / static_cast<double>(x.size());
    for (const double v : x) squares += (v - mean) * (v - mean);
    return squares;
  };
  EXPECT_GT(spread(t.f.tail(64)), 2.0 * spread(identity.f.tail(64)));
}

// On the surface the difference is that one step further in, sigma_t h = 1/4, where the flux is
// e^-1/4 = 0.78 of that at the surface, and the lower ball of the two is half cut off: the
// divergence comes out between half of its value and all of it.
TEST_F(SourceTermsOfASlab, DifferentiatedFormOnTheSurface) {
  SourceTermOptions options;
  options.divergence = Divergence::differentiated;
  const SourceTerms t = terms(options, 0.5);
  const double scattered = -3.0 * 1.8 * 0.56 * exact_U_ri(0.0) - 3.0 * 0.56 / (4.0 * pi) * 0.4;
  double mean = 0.0;
  for (const double f : t.f.head(64)) mean += f / 64.0;
  const double share = (mean - scattered) / (exact_f(0.0) - scattered);
  EXPECT_GT(share, 0.4);
  EXPECT_LT(share, 1.0);
}

TEST_F(SourceTermsOfASlab, OnePointIsOneOfMany) {
  for (const Divergence d : {Divergence::identity, Divergence::differentiated}) {
    SourceTermOptions options;
    options.divergence = d;
    const SourceTerms t = terms(options, 0.5);
    const Vec3 x = grid(-0.5).col(5);
    EXPECT_EQ(source_term(x, map_, medium_, options, *caster_, 0), t.f[64 + 5]);
  }
}

TEST_F(SourceTermsOfASlab, SameBitsForAnyNumberOfWorkers) {
  const SourceTerms one = terms({}, 0.5, 1);
  const SourceTerms two = terms({}, 0.5, 2);
  EXPECT_TRUE(one.f == two.f);
  EXPECT_TRUE(one.g == two.g);
  EXPECT_EQ(one.mean_relative_error, two.mean_relative_error);
}

TEST(SourceTerms, EmissionAloneIsExact) {
  const Medium m{0.5, 1.5, 0.5, 1.4, 2.0};
  const Scene scene = scene_of({}, {translucent(Sphere{}, m)});
  const auto caster = caster_of(scene);
  const VolumePhotonMap map({}, m);
  const Points boundary = Vec3::UnitZ().replicate(1, 1);
  const Points interior = Vec3(0.1, 0.2, 0.3).replicate(1, 1);
  for (const Divergence d : {Divergence::identity, Divergence::differentiated}) {
    SourceTermOptions options;
    options.divergence = d;
    const SourceTerms t =
        source_terms(boundary, boundary, interior, map, m, options, *caster, 0, Workers(1));
    const double exact = -3.0 * m.sigma_tr() / (4.0 * pi) * 2.0;
    EXPECT_DOUBLE_EQ(t.f[0], exact);
    EXPECT_DOUBLE_EQ(t.f[1], exact);
    EXPECT_EQ(t.g[0], 0.0);
    EXPECT_EQ(t.mean_relative_error, 0.0);
  }
}

}  // namespace
}  // namespace knotlight
