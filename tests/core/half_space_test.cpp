#include "core/half_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/phase_function.h"
#include "core/rng.h"
#include "core/vec3.h"
#include "support/statistics.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// int_0^1 f dnu by the midpoint rule in x, nu = sin(pi / 2 x^2): close about grazing, and smooth in
// the angle about the normal.
double over_cosines(int n, const std::function<double(double)>& f) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    sum += f(std::sin(0.5 * pi * x * x)) * std::cos(0.5 * pi * x * x) * pi * x;
  }
  return sum / n;
}

// int_0^pi f dphi, close about 0.
double over_azimuths(int n, const std::function<double(double)>& f) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    sum += f(pi * x * x * x) * 3.0 * pi * x * x;
  }
  return sum / n;
}

// Chandrasekhar's H by its integral equation [Ch60 ch. V],
// 1 / H = sqrt(1 - albedo) + albedo / 2 int nu H(nu) / (mu + nu) dnu, iterated to a fixed point.
class H {
 public:
  explicit H(double albedo) : albedo_(albedo) {
    for (int i = 0; i < points; ++i) {
      const double x = (i + 0.5) / points;
      nodes_.push_back({x * x * x, 3.0 * x * x / points, 1.0});
    }
    for (int step = 0; step < 100; ++step) {
      std::vector<Node> next = nodes_;
      for (Node& node : next) node.h = 0.5 * (node.h + (*this)(node.nu));
      nodes_ = next;
    }
  }
  double operator()(double mu) const {
    double sum = 0.0;
    for (const Node& node : nodes_) sum += node.weight * node.nu * node.h / (mu + node.nu);
    return 1.0 / (std::sqrt(1.0 - albedo_) + 0.5 * albedo_ * sum);
  }

 private:
  static constexpr int points = 400;
  struct Node {
    double nu, weight, h;
  };

  double albedo_;
  std::vector<Node> nodes_;
};

Vec3 direction(double mu, double phi) {
  const double s = std::sqrt(std::max(0.0, 1.0 - mu * mu));
  return {s * std::cos(phi), s * std::sin(phi), mu};
}

// Chandrasekhar's table of H for albedo 1: H(0.5) = 2.0128, H(1) = 2.9078.
TEST(HalfSpaceReflection, WhiteIsotropicIsChandrasekhars) {
  const HalfSpaceReflection half_space(1.0, 0.0);
  const double total = half_space.multiple(1.0, 0.5, 0.0) + half_space.single(1.0, 0.5, 0.0);
  EXPECT_NEAR(total, 2.9078 * 2.0128 / (4.0 * pi * 1.5), 1e-4 * total);
}

// albedo / (4 pi) H(mu) H(mu0) / (mu + mu0) and the same without H H, which is single scattering.
TEST(HalfSpaceReflection, IsotropicIsHH) {
  const std::array cosines{0.005, 0.02, 0.1, 0.3, 0.6, 0.95, 1.0};
  for (const double albedo : {0.3, 0.9, 0.99, 0.9999, 1.0}) {
    const HalfSpaceReflection half_space(albedo, 0.0);
    const H h(albedo);
    for (const double mu : cosines) {
      for (const double mu0 : cosines) {
        const double once = albedo / (4.0 * pi * (mu + mu0));
        const double more = once * (h(mu) * h(mu0) - 1.0);
        EXPECT_NEAR(half_space.single(mu, mu0, 0.3), once, 1e-12 * once);
        EXPECT_NEAR(half_space.multiple(mu, mu0, 0.3), more, 1e-3 * more)
            << albedo << " " << mu << " " << mu0;
      }
    }
  }
}

// Nothing is lost at albedo 1, whatever the light's direction: int total mu dmu dphi = 1. What is
// summed here are interpolated values, on a grid that is close about grazing and straight on (g >
// 0) or back (g < 0).
TEST(HalfSpaceReflection, WhiteGivesAllBack) {
  constexpr int cosines = 300;
  constexpr int azimuths = 200;
  for (const double g : {0.0, 0.5, 0.8, 0.9, 0.95, -0.5}) {
    const HalfSpaceReflection half_space(1.0, g);
    for (const double mu0 : {0.01, 0.1, 0.5, 1.0}) {
      const double all = over_cosines(cosines, [&](double mu) {
        return 2.0 * mu * over_azimuths(azimuths, [&](double phi) {
                 const double cos_phi = (g < 0.0 ? -1.0 : 1.0) * std::cos(phi);
                 return half_space.multiple(mu, mu0, cos_phi) + half_space.single(mu, mu0, cos_phi);
               });
      });
      EXPECT_NEAR(all, 1.0, 1e-3) << g << " " << mu0;
    }
  }
}

// An albedo so low that "at least twice" is "twice": with the light on its way at -nu or nu between
// the two, and the integrals over both depths done,
// (mu + mu0) rho_2 = albedo^2 (int_down p p mu / (mu + nu) dw + int_up p p mu0 / (mu0 + nu) dw).
double scattered_twice(double albedo, double g, double mu, double mu0, double phi) {
  constexpr int cosines = 400;
  constexpr int azimuths = 400;
  const Vec3 in = direction(-mu0, 0.0);
  const Vec3 out = direction(mu, phi);
  const double sum = over_cosines(cosines, [&](double nu) {
    double ring = 0.0;
    for (int j = 0; j < azimuths; ++j) {
      const double psi = 2.0 * pi * (j + 0.5) / azimuths;
      const Vec3 down = direction(-nu, psi);
      const Vec3 up = direction(nu, psi);
      ring +=
          henyey_greenstein(in.dot(down), g) * henyey_greenstein(down.dot(out), g) * mu /
              (mu + nu) +
          henyey_greenstein(in.dot(up), g) * henyey_greenstein(up.dot(out), g) * mu0 / (mu0 + nu);
    }
    return ring * 2.0 * pi / azimuths;
  });
  return albedo * albedo * sum / (mu + mu0);
}

struct Angles {
  double mu, mu0, phi;
};

TEST(HalfSpaceReflection, DarkIsScatteredTwice) {
  constexpr double albedo = 1e-5;  // scattered thrice: at most this part of all
  struct Case {
    double g;
    // Relative. Measured 4e-4 at most; 1.3e-2 for g = 0.95, straight back, where the streams'
    // ripples weigh most against so little light, and 4e-3 elsewhere.
    double tolerance;
  };
  for (const Case c : {Case{0.0, 1e-3}, Case{0.5, 1e-3}, Case{0.8, 1e-3}, Case{0.95, 2e-2},
                       Case{-0.5, 1e-3}, Case{-0.8, 1e-3}}) {
    const HalfSpaceReflection half_space(albedo, c.g);
    for (const Angles a : {Angles{0.01, 0.01, 0.0}, Angles{0.02, 0.05, 0.2}, Angles{0.03, 0.02, pi},
                           Angles{0.01, 0.7, 1.0}, Angles{0.2, 0.3, 0.0}, Angles{0.2, 0.3, 0.7},
                           Angles{0.985, 0.1, 0.3}, Angles{0.6, 0.5, 2.0}, Angles{1.0, 1.0, 0.0}}) {
      const double expected = scattered_twice(albedo, c.g, a.mu, a.mu0, a.phi);
      const double found = half_space.multiple(a.mu, a.mu0, std::cos(a.phi));
      EXPECT_NEAR(found, expected, c.tolerance * expected)
          << c.g << " " << a.mu << " " << a.mu0 << " " << a.phi;
    }
  }
}

TEST(HalfSpaceReflection, ReciprocalAndPositive) {
  const std::array cosines{0.002, 0.01, 0.04, 0.13, 0.37, 0.71, 0.99, 1.0};
  for (const double g : {0.0, 0.4, 0.8, 0.95, 0.99, -0.5}) {
    for (const double albedo : {0.2, 0.95, 1.0}) {
      const HalfSpaceReflection half_space(albedo, g);
      for (const double mu : cosines)
        for (const double mu0 : cosines)
          for (const double cos_phi : {-1.0, -0.6, 0.1, 0.9, 0.999, 1.0}) {
            const double rho = half_space.multiple(mu, mu0, cos_phi);
            // A forward peak that the streams cannot resolve leaves some places empty.
            if (g <= 0.95)
              EXPECT_GT(rho, 0.0) << g << " " << albedo << " " << mu << " " << mu0 << " "
                                  << cos_phi;
            else
              EXPECT_GE(rho, 0.0) << g << " " << albedo << " " << mu << " " << mu0 << " "
                                  << cos_phi;
            // The table is stored in single precision.
            EXPECT_NEAR(rho, half_space.multiple(mu0, mu, cos_phi), 1e-6 * rho);
          }
    }
  }
}

TEST(HalfSpaceReflection, BlackGivesNothingBack) {
  const HalfSpaceReflection half_space(0.0, 0.5);
  EXPECT_EQ(half_space.multiple(0.3, 0.4, 0.5), 0.0);
  EXPECT_EQ(half_space.single(0.3, 0.4, 0.5), 0.0);
}

// Photons through the half-space; at every scattering the light that would leave in each of some
// directions is added (next-event estimation), the first scattering apart from all others.
struct Walked {
  std::vector<test::Mean> once, more;
};
Walked walk(double albedo, double g, double mu0, const std::vector<Vec3>& leaving, int photons) {
  Walked result{std::vector<test::Mean>(leaving.size()), std::vector<test::Mean>(leaving.size())};
  constexpr double least_weight = 0.1;  // below, roulette with odds of one half
  for (int i = 0; i < photons; ++i) {
    Rng rng(1960, Stream::tests, static_cast<std::uint64_t>(i));
    std::vector<double> more(leaving.size(), 0.0);
    Vec3 w = direction(-mu0, 0.0);
    double depth = 0.0;
    double weight = 1.0;
    for (int order = 1; weight > 0.0; ++order) {
      depth += std::log(1.0 - rng.uniform()) * w.z();
      if (depth < 0.0) {
        if (order == 1) ADD_FAILURE() << "light left unscattered";
        break;
      }
      weight *= albedo;
      for (std::size_t k = 0; k < leaving.size(); ++k) {
        const double mu = leaving[k].z();
        const double radiance =
            weight * henyey_greenstein(w.dot(leaving[k]), g) * std::exp(-depth / mu) / mu;
        if (order == 1)
          result.once[k].add(radiance);
        else
          more[k] += radiance;
      }
      if (weight < least_weight) weight = rng.uniform() < 0.5 ? 2.0 * weight : 0.0;
      const double u = rng.uniform();
      w = sample_henyey_greenstein(w, g, u, rng.uniform());
    }
    for (std::size_t k = 0; k < leaving.size(); ++k) result.more[k].add(more[k]);
  }
  return result;
}

// 6 directions and 2 orders of 3 media, each off by more than 4.9 standard errors with probability
// 1e-6. With 100000 photons a standard error is 0.4 to 2.2 % of the light scattered at least twice.
TEST(HalfSpaceReflection, AgreesWithPhotons) {
  struct Case {
    double albedo, g, mu0;
  };
  constexpr int photons = 100'000;
  constexpr double table_error = 1e-3;  // of all light reflected
  const std::vector<Angles> angles{{1.0, 0.0, 0.0}, {0.7, 0.0, 0.3}, {0.7, 0.0, 2.5},
                                   {0.4, 0.0, 1.2}, {0.2, 0.0, 0.2}, {0.15, 0.0, pi}};
  std::vector<Vec3> leaving;
  for (const Angles& a : angles) leaving.push_back(direction(a.mu, a.phi));
  for (const Case c : {Case{0.99, 0.8, 0.6}, Case{0.99, 0.8, 0.1}, Case{0.9, -0.5, 0.8}}) {
    const HalfSpaceReflection half_space(c.albedo, c.g);
    const Walked found = walk(c.albedo, c.g, c.mu0, leaving, photons);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      const double cos_phi = std::cos(angles[k].phi);
      const double once = half_space.single(angles[k].mu, c.mu0, cos_phi);
      const double more = half_space.multiple(angles[k].mu, c.mu0, cos_phi);
      EXPECT_NEAR(found.once[k].mean(), once,
                  test::z_one_in_a_million * found.once[k].standard_error())
          << c.g << " " << c.mu0 << " " << k;
      EXPECT_NEAR(
          found.more[k].mean(), more,
          test::z_one_in_a_million * found.more[k].standard_error() + table_error * (once + more))
          << c.g << " " << c.mu0 << " " << k;
      EXPECT_LT(found.more[k].standard_error(), 0.03 * more);
    }
  }
}

}  // namespace
}  // namespace knotlight
