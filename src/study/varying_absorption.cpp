#include "study/varying_absorption.h"

#include <array>
#include <cmath>

namespace knotlight {
namespace {

constexpr int most_iterations = 5000;  // ten times what the finest grid of the study takes

// Seven coefficients per corner: three couplings to the next one, and the diagonal.
struct SevenPoints {
  Eigen::Index n;  // corners per edge
  std::array<Eigen::VectorXd, 3> next;
  Eigen::VectorXd diagonal;

  std::array<Eigen::Index, 3> strides() const { return {n * n, n, 1}; }

  Eigen::VectorXd operator*(const Eigen::VectorXd& u) const {
    Eigen::VectorXd result = diagonal.cwiseProduct(u);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Eigen::Index stride = strides()[axis], rest = u.size() - stride;
      const auto coupling = next[axis].head(rest);
      result.head(rest) -= coupling.cwiseProduct(u.tail(rest));
      result.tail(rest) -= coupling.cwiseProduct(u.head(rest));
    }
    return result;
  }
};

void conjugate_gradients(const SevenPoints& A, const Eigen::VectorXd& b, double tolerance,
                         CubeSolution& result) {
  result.U = Eigen::VectorXd::Zero(b.size());
  const double wanted = tolerance * b.norm();
  Eigen::VectorXd r = b, z = r.cwiseQuotient(A.diagonal), p = z;
  double rz = r.dot(z);
  while (result.iterations < most_iterations && !result.converged) {
    const Eigen::VectorXd Ap = A * p;
    const double alpha = rz / p.dot(Ap);
    result.U += alpha * p;
    r -= alpha * Ap;
    z = r.cwiseQuotient(A.diagonal);
    const double next = r.dot(z);
    p = z + next / rz * p;
    rz = next;
    ++result.iterations;
    result.converged = r.norm() <= wanted;
  }
}

}  // namespace

Eigen::VectorXd radial_differences(int n, const RadialProblem& p) {
  const double h = 1.0 / n;
  const auto cube = [](double r) { return r * r * r / 3.0; };
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(n + 1), right = diagonal, next = diagonal;
  for (int i = 0; i < n; ++i) {  // from r_i to r_(i + 1), half of it each one's
    const double inner = i * h, middle = inner + 0.5 * h, outer = inner + h;
    const double coupling = p.spread(middle) * middle * middle / h;
    next[i] = coupling;
    for (const auto& [at, volume] :
         {std::pair{i, cube(middle) - cube(inner)}, std::pair{i + 1, cube(outer) - cube(middle)}}) {
      diagonal[at] += coupling + p.sigma(middle) * volume;
      right[at] += p.source(middle) * volume;
    }
  }
  diagonal[n] += 1.0 / p.k;  // the flux U / k through the surface
  // Elimination upwards, then back.
  for (int i = 1; i <= n; ++i) {
    const double factor = next[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * next[i - 1];
    right[i] += factor * right[i - 1];
  }
  Eigen::VectorXd U(n + 1);
  U[n] = right[n] / diagonal[n];
  for (int i = n - 1; i >= 0; --i) U[i] = (right[i] + next[i] * U[i + 1]) / diagonal[i];
  return U;
}

CubeSolution cube_differences(int n, const CubeProblem& p, double tolerance) {
  const Eigen::Index corners = n + 1;
  const Eigen::Index count = corners * corners * corners;
  const double h = p.side / n;
  SevenPoints A{corners, {}, Eigen::VectorXd::Zero(count)};
  for (Eigen::VectorXd& coupling : A.next) coupling = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(count);
  const auto strides = A.strides();
  // Each cell gives an eighth of itself to each of its corners, and to each of its twelve edges a
  // quarter of the area that light crosses along it.
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int l = 0; l < n; ++l) {
        const Vec3 center = h * Vec3(i + 0.5, j + 0.5, l + 0.5);
        const double absorbed = p.sigma(center) * h * h * h / 8.0;
        const double lit = p.source(center) * h * h / 4.0;
        for (int corner = 0; corner < 8; ++corner) {
          const std::array<int, 3> at = {i + (corner >> 2), j + (corner >> 1 & 1),
                                         l + (corner & 1)};
          const Eigen::Index own = at[0] * strides[0] + at[1] * strides[1] + at[2];
          const double low = h * (l + 0.5 * (corner & 1));  // of its eighth
          const double along =
              p.steep > 0.0 ? std::exp(-p.steep * low) * -std::expm1(-0.5 * p.steep * h) / p.steep
                            : 0.5 * h;
          b[own] += lit * along;
          A.diagonal[own] += absorbed;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            A.diagonal[own] += h / 4.0;
            if (at[axis] == 0 || at[axis] == n) A.diagonal[own] += h * h / 4.0 / p.k;
            const bool lower = (corner >> (2 - axis) & 1) == 0;
            if (lower) A.next[axis][own] += h / 4.0;
          }
        }
      }
  CubeSolution result;
  result.n = n;
  conjugate_gradients(A, b, tolerance, result);
  return result;
}

}  // namespace knotlight
