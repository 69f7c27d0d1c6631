// Bodies given by formulas and fields known in closed form, for tests of the boundary solvers.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "bkm/patch_tree.h"

namespace knotlight {

struct FormulaBody {
  std::shared_ptr<SpreadKnots> knots = std::make_shared<SpreadKnots>();
  BodyQueries queries;
};

// Balls that do not overlap. Knots on spirals of each, taken in an order whose prefixes are spread.
inline FormulaBody balls(const std::vector<Vec3>& centers, double radius, int bits) {
  FormulaBody body;
  const int each = 1 << bits;
  const auto count = static_cast<int>(centers.size());
  body.knots->positions.resize(3, each * count);
  body.knots->normals.resize(3, each * count);
  body.knots->area = 4.0 * std::numbers::pi * radius * radius * count;
  for (int i = 0; i < each; ++i) {
    int reversed = 0;
    for (int b = 0; b < bits; ++b) reversed |= ((i >> b) & 1) << (bits - 1 - b);
    const double z = (2.0 * reversed + 1.0) / each - 1.0;
    const double phi = 2.399963229728653 * reversed;  // the golden angle
    const double s = std::sqrt(1.0 - z * z);
    for (int c = 0; c < count; ++c) {
      const Vec3 n(s * std::cos(phi), s * std::sin(phi), z);
      body.knots->normals.col(i * count + c) = n;
      body.knots->positions.col(i * count + c) = centers[static_cast<std::size_t>(c)] + radius * n;
    }
  }
  const auto nearest = [centers](const Vec3& x) {
    return *std::min_element(centers.begin(), centers.end(), [&](const Vec3& a, const Vec3& b) {
      return (x - a).squaredNorm() < (x - b).squaredNorm();
    });
  };
  body.queries.inside = [=](const Vec3& x) { return (x - nearest(x)).norm() < radius; };
  body.queries.connected = [=](const Vec3& a, const Vec3& b) { return nearest(a) == nearest(b); };
  body.queries.thickness = [=](const Vec3& x, const Vec3& d) {
    return -2.0 * (x - nearest(x)).dot(d);
  };
  return body;
}

// exp(-lambda r)/r of a source outside the body: a solution that no kernel of the solvers is.
struct OutsideSource {
  Vec3 at;
  double lambda;

  double value(const Vec3& x) const {
    const double r = (x - at).norm();
    return std::exp(-lambda * r) / r;
  }
  double robin(const Vec3& x, const Vec3& n, double k) const {
    const double r = (x - at).norm();
    return value(x) * (1.0 - k * (lambda + 1.0 / r) * (x - at).dot(n) / r);
  }
};

}  // namespace knotlight
