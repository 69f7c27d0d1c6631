#include "core/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fresnel.h"
#include "core/sampling.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;

const Vec3 normal = Vec3(0.3, -0.5, 0.8).normalized();

Vec3 arriving(double angle) {
  return Frame(normal).to_world({std::sin(angle) * 0.6, std::sin(angle) * 0.8, -std::cos(angle)});
}

// The whole sphere of directions in cells of equal solid angle, fine beside the lobes tested.
constexpr int rows = 24, columns = 24, sub_rows = 40, sub_columns = 10;
template <class F>
std::vector<double> integrate_cells(const F& f) {
  const Frame frame(normal);
  std::vector<double> cells(rows * columns, 0.0);
  for (int i = 0; i < rows * sub_rows; ++i)
    for (int j = 0; j < columns * sub_columns; ++j) {
      const double z = 2.0 * (i + 0.5) / (rows * sub_rows) - 1.0;
      const double phi = 2.0 * pi * (j + 0.5) / (columns * sub_columns);
      const double s = std::sqrt(1.0 - z * z);
      cells[static_cast<std::size_t>(i / sub_rows * columns + j / sub_columns)] +=
          f(frame.to_world({s * std::cos(phi), s * std::sin(phi), z})) * 4.0 * pi /
          (rows * sub_rows * columns * sub_columns);
    }
  return cells;
}

std::size_t cell_of(const Vec3& w) {
  const Frame frame(normal);
  const double turn = std::atan2(w.dot(frame.b), w.dot(frame.t)) / (2.0 * pi);
  const int i = std::min(rows - 1, static_cast<int>((w.dot(frame.n) + 1.0) * 0.5 * rows));
  const int j = std::min(columns - 1, static_cast<int>((turn < 0.0 ? turn + 1.0 : turn) * columns));
  return static_cast<std::size_t>(i * columns + j);
}

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double v : values) total += v;
  return total;
}

constexpr double etas[] = {1.5, 1.0 / 1.5};
constexpr double angles[] = {0.0, 0.7, 1.3};

// Directions of positive weight against their density, cell by cell: chi-square over cells expected
// to hold 20 of 100 000 samples or more, the others pooled with what ends on the wrong side. Twelve
// tests, a false alarm in 2e6 each. Weights add up to the power, within 4.892 standard errors.
TEST(Microfacet, SamplesFollowTheirDensity) {
  constexpr int n = 100'000;
  for (const double eta : etas)
    for (const double angle : angles)
      for (const double alpha : {0.4, 0.9}) {
        const Vec3 d = arriving(angle);
        const auto density =
            integrate_cells([&](const Vec3& w) { return facet_pdf(d, w, normal, eta, alpha); });
        const auto power =
            integrate_cells([&](const Vec3& w) { return facet_power(d, w, normal, eta, alpha); });
        Rng rng(1, Stream::tests, 0);
        std::vector<double> counts(density.size(), 0.0);
        test::Mean weight;
        for (int i = 0; i < n; ++i) {
          const double u = rng.uniform();
          const double v = rng.uniform();
          const FacetEvent event = sample_facet(d, normal, eta, alpha, u, v, rng.uniform());
          ASSERT_NEAR(event.direction.norm(), 1.0, 1e-12);
          weight.add(event.weight);
          if (event.weight == 0.0) continue;
          ASSERT_EQ(event.transmitted, event.direction.dot(normal) < 0.0);
          counts[cell_of(event.direction)] += 1.0;
        }
        std::vector<double> tested{static_cast<double>(n)}, expected{static_cast<double>(n)};
        for (std::size_t i = 0; i < density.size(); ++i) {
          if (n * density[i] < 20.0) continue;
          tested.push_back(counts[i]);
          expected.push_back(n * density[i]);
          tested[0] -= counts[i];
          expected[0] -= n * density[i];
        }
        if (expected[0] < 20.0) {
          tested.erase(tested.begin());
          expected.erase(expected.begin());
        }
        EXPECT_GT(tested.size(), 20U);
        EXPECT_LT(test::chi_square_z(tested, expected), test::z_one_in_a_million)
            << eta << ' ' << angle << ' ' << alpha;
        // The midpoint rule errs by up to 3e-3 where a lobe falls on the pole of the cells.
        EXPECT_NEAR(weight.mean(), sum(power),
                    test::z_one_in_a_million * weight.standard_error() + 5e-3);
        EXPECT_LE(weight.mean(), 1.0);
      }
}

// f_s is the same both ways but for the compression of radiance: with P = f_s |out . n|,
// P(d -> out) |d . n| = eta^2 P(-out -> -d) |out . n| across the surface, without eta^2 on one
// side.
TEST(Microfacet, ReciprocalAfterOneFacet) {
  Rng rng(1, Stream::tests, 1);
  int transmitted = 0;
  for (int i = 0; i < 1000; ++i) {
    const double eta = i % 2 == 0 ? 1.5 : 1.0 / 1.5;
    const Vec3 d = arriving(1.5 * rng.uniform());
    const double u = rng.uniform();
    const double v = rng.uniform();
    const FacetEvent event = sample_facet(d, normal, eta, 0.5, u, v, rng.uniform());
    if (event.weight == 0.0) continue;
    const Vec3& out = event.direction;
    const double there = facet_power(d, out, normal, eta, 0.5) * std::abs(d.dot(normal));
    const double back_eta = event.transmitted ? 1.0 / eta : eta;
    const double back = facet_power(-out, -d, normal, back_eta, 0.5) * std::abs(out.dot(normal));
    EXPECT_NEAR(there / (back * (event.transmitted ? eta * eta : 1.0)), 1.0, 1e-6);
    EXPECT_GT(there, 0.0);
    transmitted += event.transmitted ? 1 : 0;
  }
  EXPECT_GT(transmitted, 300);
}

// alpha -> 0: the smooth surface's two directions, with its reflectance as the share of the first.
// 20 000 dice per angle, a false alarm once in a million.
TEST(Microfacet, SmoothInTheLimit) {
  constexpr double alpha = 1e-5;
  for (const double eta : etas)
    for (const double angle : {0.0, 0.5, 1.2}) {
      const Vec3 d = arriving(angle);
      const auto refracted = refract(d, normal, eta);
      const double R = fresnel_reflectance(std::cos(angle), eta);
      Rng rng(1, Stream::tests, 2);
      constexpr int n = 20'000;
      int reflected = 0;
      double worst = 0.0;
      for (int i = 0; i < n; ++i) {
        const SurfaceEvent event = cross_rough_surface(d, normal, eta, alpha, rng);
        reflected += event.transmitted ? 0 : 1;
        const Vec3 smooth = event.transmitted ? *refracted : reflect(d, normal);
        worst = std::max(worst, (event.direction - smooth).norm());
      }
      EXPECT_NEAR(reflected / static_cast<double>(n), R,
                  test::z_one_in_a_million * std::sqrt(R * (1.0 - R) / n) + 1e-5);
      // Slopes of more than 100 alpha have a share of 1e-4; refraction turns by a few times that.
      EXPECT_LT(worst, 0.05);
    }
}

// Every direction ends on the side it says, at any angle and roughness, from either side of the
// normal given.
TEST(Microfacet, AllLightGoesOn) {
  Rng rng(1, Stream::tests, 3);
  for (const double eta : etas)
    for (const double angle : {0.0, 0.8, 1.5, 1.57079})
      for (const double alpha : {0.001, 0.1, 1.0})
        for (const Vec3& n : {normal, Vec3(-normal)})
          for (int i = 0; i < 300; ++i) {
            const SurfaceEvent event = cross_rough_surface(arriving(angle), n, eta, alpha, rng);
            ASSERT_TRUE(event.direction.allFinite());
            ASSERT_EQ(event.transmitted, event.direction.dot(normal) < 0.0);
          }
}

// The walks that end after one facet are the single events: 40 000 walks per case, a false alarm
// once in a million. Of walks into the denser medium at alpha = 0.1 few need a second facet.
TEST(Microfacet, WalksOfOneFacetAreSingleEvents) {
  constexpr int n = 40'000;
  for (const double eta : etas)
    for (const double angle : angles)
      for (const double alpha : {0.1, 0.9}) {
        const Vec3 d = arriving(angle);
        Rng rng(1, Stream::tests, 4);
        test::Mean weight, transmitted, weight_transmitted, single, single_transmitted;
        for (int i = 0; i < n; ++i) {
          const double u = rng.uniform();
          const double v = rng.uniform();
          const FacetEvent event = sample_facet(d, normal, eta, alpha, u, v, rng.uniform());
          weight.add(event.weight);
          weight_transmitted.add(event.transmitted ? event.weight : 0.0);
          const SurfaceEvent walk = cross_rough_surface(d, normal, eta, alpha, rng);
          single.add(walk.facets == 1 ? 1.0 : 0.0);
          single_transmitted.add(walk.facets == 1 && walk.transmitted ? 1.0 : 0.0);
        }
        const auto expect_same = [&](const test::Mean& a, const test::Mean& b) {
          EXPECT_NEAR(a.mean(), b.mean(),
                      test::z_one_in_a_million * std::hypot(a.standard_error(), b.standard_error()))
              << eta << ' ' << angle << ' ' << alpha;
        };
        expect_same(weight, single);
        expect_same(weight_transmitted, single_transmitted);
        if (alpha == 0.1 && eta > 1.0 && angle < 1.0) {
          EXPECT_GT(single.mean(), 0.99);
        }
      }
}

// Even light on both sides, of radiance n^2 within the denser one, stays even: as much comes
// through either way. 200 000 walks per side, a false alarm once in a million.
TEST(Microfacet, EvenLightPassesBothWaysAlike) {
  constexpr double ior = 1.4;
  constexpr int n = 200'000;
  for (const double alpha : {0.05, 0.3, 1.0}) {
    test::Mean through[2];
    for (const int side : {0, 1}) {
      Rng rng(1, Stream::tests, 5 + static_cast<std::uint64_t>(side));
      const Frame frame(normal);
      for (int i = 0; i < n; ++i) {
        const double u = rng.uniform();
        const Vec3 d = -frame.to_world(sample_cosine_hemisphere(u, rng.uniform()));
        through[side].add(
            cross_rough_surface(d, normal, side == 0 ? ior : 1.0 / ior, alpha, rng).transmitted);
      }
    }
    EXPECT_NEAR(ior * ior * through[1].mean(), through[0].mean(),
                test::z_one_in_a_million * std::hypot(ior * ior * through[1].standard_error(),
                                                      through[0].standard_error()))
        << alpha;
  }
}

}  // namespace
}  // namespace knotlight
