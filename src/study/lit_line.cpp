#include "study/lit_line.h"

#include <cmath>

namespace knotlight {
namespace {

using std::numbers::pi;

constexpr double visible = 0.01;  // of the largest value: what an eye would see as a ring

int turns_of(const Eigen::VectorXd& v) {
  const double least = visible * v.cwiseAbs().maxCoeff();
  double low = v[0], high = v[0];
  int rings = 0;
  bool falling = true;  // as the true field does
  for (const double x : v) {
    if (falling) {
      low = std::min(low, x);
      if (x <= low + least) continue;
      high = x;
    } else {
      high = std::max(high, x);
      if (x >= high - least) continue;
      low = x;
    }
    falling = !falling;
    ++rings;
  }
  return rings;
}

}  // namespace

PoleToPole pole_to_pole(const FieldValues& u) {
  PoleToPole line;
  line.degrees.resize(PoleToPole::angles);
  line.mean.resize(PoleToPole::angles);
  double apart = 0.0, all = 0.0;
  for (int i = 0; i < PoleToPole::angles; ++i) {
    const double theta = pi * i / (PoleToPole::angles - 1);
    Points circle(3, PoleToPole::turns);
    for (int j = 0; j < PoleToPole::turns; ++j) {
      const double phi = 2.0 * pi * j / PoleToPole::turns;
      circle.col(j) =
          Vec3(-std::cos(theta), std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi));
    }
    const Eigen::VectorXd values = u(circle);
    line.degrees[i] = 180.0 * theta / pi;
    line.mean[i] = values.mean();
    apart += std::sin(theta) * (values.array() - values.mean()).square().sum();
    all += std::sin(theta) * values.squaredNorm();
  }
  line.unevenness = std::sqrt(apart / all);
  line.rings = turns_of(line.mean);
  line.lowest = line.mean.minCoeff() / line.mean.cwiseAbs().maxCoeff();
  return line;
}

ChartSeries series_of(const std::string& name, const PoleToPole& line, double factor) {
  ChartSeries series{name, {}, {}, {}, true, false};
  for (Eigen::Index i = 0; i < line.mean.size(); ++i) {
    series.x.push_back(line.degrees[i]);
    series.y.push_back(factor * line.mean[i]);
  }
  return series;
}

double best_factor(const Eigen::VectorXd& u, const Eigen::VectorXd& truth) {
  return u.dot(truth) / u.squaredNorm();
}

}  // namespace knotlight
