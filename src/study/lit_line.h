// The field of a ball along the way from its lit pole to its dark one.
#pragma once

#include <numbers>

#include "pipeline/channel_problem.h"
#include "report/chart.h"
#include "study/lit_body.h"

namespace knotlight {

struct PoleToPole {
  static constexpr int angles = 61, turns = 24;  // 3 degrees apart; means over 24 meridians

  Eigen::VectorXd degrees;  // from the lit pole
  Eigen::VectorXd mean;     // of u over the circle there
  double unevenness = 0.0;  // rms over the circles of u - mean over rms of u: 0 for the true field
  // Turns of the mean from falling to rising or back, of more than 1 % of its largest size: the
  // true field only falls.
  int rings = 0;
  double lowest = 0.0;  // least mean over the largest size
};
PoleToPole pole_to_pole(const FieldValues& u);

// The mean times `factor`.
ChartSeries series_of(const std::string& name, const PoleToPole& line, double factor);
// Least squares factor that brings u to `truth`.
double best_factor(const Eigen::VectorXd& u, const Eigen::VectorXd& truth);

}  // namespace knotlight
