#include "grid/moments.h"

#include "grid/cell_grid.h"

namespace knotlight {
namespace {

using Triple = std::array<double, 3>;

Triple quadratics(double x) {
  return {(1.0 - x) * (1.0 - x), x * (1.0 - x), x * x};
}

// A child's functions along the axis whose moments are Stride apart become the parent's, by
// X = (x + offset) / 2: (1-X)^2 = (1-x)^2 + x (1-x) + x^2 / 4 and so on for the lower child, the
// mirror image of it for the upper one.
template <std::size_t Stride>
void transfer(Moments& m, int offset) {
  const std::size_t near = offset == 0 ? 0 : 2 * Stride, far = 2 * Stride - near;
  for (std::size_t line = 0; line < 9; ++line) {
    double* const at = m.data() + line % Stride + line / Stride * 3 * Stride;
    const double quarter = 0.25 * at[far], middle = at[Stride];
    at[near] += middle + quarter;
    at[Stride] = 0.5 * middle + quarter;
    at[far] = quarter;
  }
}

}  // namespace

void add_point(Moments& moments, const Vec3& x, double weight) {
  const Triple fx = quadratics(x.x()), fy = quadratics(x.y()), fz = quadratics(x.z());
  std::size_t i = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t b = 0; b < 3; ++b) {
      const double yz = weight * fy[b] * fz[c];
      for (std::size_t a = 0; a < 3; ++a) moments[i++] += fx[a] * yz;
    }
}

Moments full_cell_moments() {
  constexpr Triple integral{1.0 / 3.0, 1.0 / 6.0, 1.0 / 3.0};
  Moments m{};
  for (std::size_t i = 0; i < 27; ++i)
    m[i] = integral[i % 3] * integral[i / 3 % 3] * integral[i / 9];
  return m;
}

// 1 = (1-x)^2 + 2 x (1-x) + x^2.
double total(const Moments& moments) {
  constexpr Triple one{1.0, 2.0, 1.0};
  double sum = 0.0;
  for (std::size_t i = 0; i < 27; ++i) sum += one[i % 3] * one[i / 3 % 3] * one[i / 9] * moments[i];
  return sum;
}

void add_to_parent(Moments& parent, const Moments& child, int corner, double measure) {
  Moments m = child;
  const auto offset = corner_offset(corner);
  transfer<1>(m, offset[0]);
  transfer<3>(m, offset[1]);
  transfer<9>(m, offset[2]);
  for (std::size_t i = 0; i < 27; ++i) parent[i] += measure * m[i];
}

ElementMatrix mass_matrix(const Moments& moments) {
  ElementMatrix m;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const auto p = corner_offset(i), q = corner_offset(j);
      const int exponents = p[0] + q[0] + 3 * (p[1] + q[1]) + 9 * (p[2] + q[2]);
      m(i, j) = moments[static_cast<std::size_t>(exponents)];
    }
  return m;
}

// The derivative of a shape function along its axis is +-1, so along that axis the integrand is
// +-1 = +-((1-x)^2 + 2 x (1-x) + x^2).
ElementMatrix stiffness_matrix(const Moments& moments) {
  constexpr Triple one{1.0, 2.0, 1.0};
  ElementMatrix m = ElementMatrix::Zero();
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const auto p = corner_offset(i), q = corner_offset(j);
      const std::array<int, 3> product{p[0] + q[0], 3 * (p[1] + q[1]), 9 * (p[2] + q[2])};
      std::size_t stride = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t rest =
            static_cast<std::size_t>(product[0] + product[1] + product[2] - product[axis]);
        double sum = 0.0;
        for (std::size_t a = 0; a < 3; ++a) sum += one[a] * moments[rest + a * stride];
        m(i, j) += p[axis] == q[axis] ? sum : -sum;
        stride *= 3;
      }
    }
  return m;
}

ElementVector shape_functions(const Vec3& x) {
  ElementVector n;
  for (int c = 0; c < 8; ++c) {
    const auto o = corner_offset(c);
    n[c] =
        (o[0] ? x.x() : 1.0 - x.x()) * (o[1] ? x.y() : 1.0 - x.y()) * (o[2] ? x.z() : 1.0 - x.z());
  }
  return n;
}

}  // namespace knotlight
