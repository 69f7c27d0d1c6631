#include "reference/sphere_beam_p1.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/legendre.h"

namespace knotlight {
namespace {

using std::numbers::pi;

// U_d on the surface has a kink at the terminator that is as sharp as a transport mean free path;
// its Legendre coefficients fall as degree^-4. With these numbers, doubling any of them changes the
// tested spheres (up to 20 mean free paths) by less than 1e-5 of their largest value.
constexpr int largest_degree = 160;
constexpr int nodes_per_element = 9;
constexpr int elements = 12;  // radial, each 0.6 times as long as the one inside it
constexpr double element_ratio =
    0.6;                            // the source's layer and the high degrees live at the surface
constexpr int angular_points = 32;  // per panel
constexpr double smallest_panel = 1e-4;  // at the kink mu = 0
constexpr double largest_panel = 0.05;   // at the poles 16 half waves of the highest degree

std::vector<double> radial_borders(double radius) {
  std::vector<double> borders{0.0};
  double length = radius * (1.0 - element_ratio) / (1.0 - std::pow(element_ratio, elements));
  for (int e = 0; e < elements; ++e, length *= element_ratio)
    borders.push_back(borders.back() + length);
  borders.back() = radius;
  return borders;
}

// Gauss points over mu in [-1, 1] in panels that shrink towards the kink at 0.
Quadrature angular_quadrature() {
  const Quadrature gauss = gauss_legendre(angular_points);
  Quadrature all;
  for (const double side : {-1.0, 1.0})
    for (double from = 0.0; from < 1.0;) {
      const double to = std::min(1.0, from + std::clamp(from, smallest_panel, largest_panel));
      for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
        all.nodes.push_back(side * (from + 0.5 * (to - from) * (1.0 + gauss.nodes[i])));
        all.weights.push_back(0.5 * (to - from) * gauss.weights[i]);
      }
      from = to;
    }
  return all;
}

// Barycentric weights and slopes of the Lagrange polynomials on the element's nodes.
struct Lagrange {
  Quadrature lobatto = gauss_lobatto(nodes_per_element);
  Eigen::VectorXd barycentric{nodes_per_element};
  Eigen::MatrixXd slopes{nodes_per_element, nodes_per_element};  // (i, j): slope of j at node i

  Lagrange() {
    const auto& x = lobatto.nodes;
    for (int j = 0; j < nodes_per_element; ++j) {
      double product = 1.0;
      for (int i = 0; i < nodes_per_element; ++i)
        if (i != j) product *= x[static_cast<std::size_t>(j)] - x[static_cast<std::size_t>(i)];
      barycentric[j] = 1.0 / product;
    }
    for (int i = 0; i < nodes_per_element; ++i) {
      slopes(i, i) = 0.0;
      for (int j = 0; j < nodes_per_element; ++j)
        if (i != j) {
          slopes(i, j) = barycentric[j] / barycentric[i] /
                         (x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(j)]);
          slopes(i, i) -= slopes(i, j);  // the slopes of a constant add up to 0
        }
    }
  }

  // Value at s in [-1, 1] of the polynomial with the given values at the nodes.
  double interpolate(const Eigen::Ref<const Eigen::VectorXd>& values, double s) const {
    double above = 0.0, below = 0.0;
    for (int j = 0; j < nodes_per_element; ++j) {
      const double distance = s - lobatto.nodes[static_cast<std::size_t>(j)];
      if (distance == 0.0) return values[j];
      above += barycentric[j] / distance * values[j];
      below += barycentric[j] / distance;
    }
    return above / below;
  }
};

const Lagrange& lagrange() {
  static const Lagrange shared;
  return shared;
}

}  // namespace

// With U_d = sum u_l(r) P_l(mu), mu = z / r, and the same for f and for the Robin data g at R, each
// degree has an equation of its own. Times r^2 v(r) and integrated by parts,
//   int (u' v' r^2 + (lambda^2 r^2 + l (l + 1)) u v) dr + (R^2 / k) u(R) v(R)
//     = -int f_l v r^2 dr + (R^2 / k) g_l v(R),
// by elements of degree 8 on Lobatto points, which are the quadrature too. Coefficients of a
// function h: h_l = (l + 1/2) int h P_l dmu.
SphereBeamP1::SphereBeamP1(const Medium& medium, Boundary boundary, double radius)
    : medium_(medium),
      c_(p1_constants(medium, boundary)),
      radius_(radius),
      borders_(radial_borders(radius)) {
  if (medium.ior != 1.0) throw std::domain_error("SphereBeamP1: expected ior 1");
  const Lagrange& base = lagrange();
  constexpr int last = nodes_per_element - 1;
  constexpr Eigen::Index n = elements * last + 1;

  Eigen::VectorXd r(n), mass = Eigen::VectorXd::Zero(n);  // mass: weights of int . dr
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  for (int e = 0; e < elements; ++e) {
    const double from = borders_[static_cast<std::size_t>(e)];
    const double half = 0.5 * (borders_[static_cast<std::size_t>(e) + 1] - from);
    const Eigen::Index first = e * last;
    for (int q = 0; q <= last; ++q) {
      r[first + q] = from + half * (1.0 + base.lobatto.nodes[static_cast<std::size_t>(q)]);
      mass[first + q] += half * base.lobatto.weights[static_cast<std::size_t>(q)];
    }
    for (int q = 0; q <= last; ++q) {
      const double weight =
          base.lobatto.weights[static_cast<std::size_t>(q)] / half * r[first + q] * r[first + q];
      stiffness.block(first, first, last + 1, last + 1) +=
          weight * base.slopes.row(q).transpose() * base.slopes.row(q);
    }
  }

  const Quadrature angles = angular_quadrature();
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(n, largest_degree + 1);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(largest_degree + 1);
  const Eigen::VectorXd degrees = Eigen::VectorXd::LinSpaced(largest_degree + 1, 0, largest_degree);
  for (std::size_t a = 0; a < angles.nodes.size(); ++a) {
    const double mu = angles.nodes[a];
    const std::vector<double> p = legendre_polynomials(largest_degree, mu);
    const Eigen::VectorXd project =
        angles.weights[a] * Eigen::Map<const Eigen::VectorXd>(p.data(), largest_degree + 1)
                                .cwiseProduct((degrees.array() + 0.5).matrix());
    Eigen::VectorXd source(n);
    for (Eigen::Index i = 0; i < n; ++i)
      source[i] =
          c_.per_U_ri / (4.0 * pi) * std::exp(-medium.sigma_t() * path_from_entry(r[i], mu));
    f += source * project.transpose();
    // Q_ri along -z, so Q_ri . n = -g sigma_s mu e^(-sigma_t path).
    g += (-c_.per_Q * medium.g * medium.sigma_s * mu *
          std::exp(-medium.sigma_t() * path_from_entry(radius, mu))) *
         project;
  }

  const double surface = radius * radius / c_.k;
  const Eigen::VectorXd volume = mass.cwiseProduct(r.cwiseAbs2());
  for (int l = 0; l <= largest_degree; ++l) {
    Eigen::MatrixXd system = stiffness;
    system.diagonal() += c_.lambda * c_.lambda * volume + l * (l + 1.0) * mass;
    system(n - 1, n - 1) += surface;
    Eigen::VectorXd load = -volume.cwiseProduct(f.col(l));
    load[n - 1] += surface * g[l];
    u_.push_back(system.ldlt().solve(load));
  }
}

// Length of the beam's way from the surface to the point at distance r and polar cosine mu.
double SphereBeamP1::path_from_entry(double r, double mu) const {
  const double across2 = r * r * (1.0 - mu * mu);
  return std::max(0.0, std::sqrt(std::max(0.0, radius_ * radius_ - across2)) - r * mu);
}

double SphereBeamP1::U_ri(const Vec3& x) const {
  const double r = x.norm();
  const double mu = r > 0.0 ? std::clamp(x.z() / r, -1.0, 1.0) : 0.0;
  return std::exp(-medium_.sigma_t() * path_from_entry(r, mu)) / (4.0 * pi);
}

double SphereBeamP1::U_d(const Vec3& x) const {
  const double r = std::min(x.norm(), radius_);
  const double mu = r > 0.0 ? std::clamp(x.z() / x.norm(), -1.0, 1.0) : 0.0;
  const auto after = std::upper_bound(borders_.begin() + 1, borders_.end() - 1, r);
  const auto element = after - borders_.begin() - 1;
  const double from = *(after - 1), to = *after;
  const double s = 2.0 * (r - from) / (to - from) - 1.0;
  constexpr int last = nodes_per_element - 1;
  const std::vector<double> p = legendre_polynomials(largest_degree, mu);
  double sum = 0.0;
  for (std::size_t l = 0; l < u_.size(); ++l)
    sum += p[l] * lagrange().interpolate(u_[l].segment(element * last, last + 1), s);
  return sum;
}

// Over the chords c of the ball, uniform over its cross-section: mean of e^(-sigma_t c) =
// (2 / x^2) (1 - (1 + x) e^-x), x = 2 sigma_t R.
double SphereBeamP1::power_in() const {
  const double x = 2.0 * medium_.sigma_t() * radius_;
  return pi * radius_ * radius_ * (1.0 - 2.0 / (x * x) * (1.0 - (1.0 + x) * std::exp(-x)));
}

// Only degree 0 has a mean over the sphere.
double SphereBeamP1::power_leaving() const {
  return 4.0 * pi * radius_ * radius_ * c_.out_per_U * u_[0][u_[0].size() - 1];
}

double SphereBeamP1::power_absorbed() const {
  return medium_.albedo() * power_in() - power_leaving();
}

}  // namespace knotlight
