// The basis sinh(lambda r)/(lambda r) has a hard numerical rank. On a sphere of radius R
//   sinh(lambda|x-y|)/(lambda|x-y|) = sum_l (2l+1) i_l(lambda R)^2 P_l(cos angle),
// so the singular values come in groups of 2l+1 that fall like i_l^2, faster than geometrically;
// what is above the cut is l = 0..L, (L+1)^2 in all, however many knots there are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bkm/assembly.h"
#include "bkm/bkm_cases.h"
#include "bkm/dense_solver.h"
#include "bkm/thesis_solver.h"

namespace knotlight {
namespace {

using namespace bkm_cases;

constexpr double cut = 1e-14;

int rank(int knots, double lambda, double k, double relative_cut = cut) {
  const Surface s = sphere(knots);
  const RadialFunction w{RadialKind::nonsingular, 1.0, 1.0, 0, lambda, 2.0};
  const int found = DenseSolver(robin_matrix(s.points, s.normals, s.points, k, w),
                                {DenseMethod::svd, relative_cut})
                        .rank();
  testing::Test::RecordProperty(fmt::format("rank_of_{}_knots_at_{:.2f}", knots, lambda), found);
  return found;
}

// Five mean free paths, reduced albedo 0.9: lambda R = 2.74.
TEST(Rank, SaturatesAtAPerfectSquare) {
  const double sigma_tr = 5.0, lambda = std::sqrt(3.0 * 0.1) * sigma_tr;
  const double k = 2.0 / (3.0 * sigma_tr);
  EXPECT_EQ(rank(100, lambda, k), 100);
  EXPECT_EQ(rank(500, lambda, k), 144);
  EXPECT_EQ(rank(700, lambda, k), 144);
}

// Nearly white: lambda R = 0.27 leaves 36.
TEST(Rank, FallsWithLambda) {
  const double sigma_tr = 5.0, lambda = std::sqrt(3.0 * 0.001) * sigma_tr;
  EXPECT_EQ(rank(500, lambda, 2.0 / (3.0 * sigma_tr)), 36);
}

// What the rank costs: a point source one mean free path above the surface is not represented any
// better by more knots.
TEST(Rank, MoreKnotsDoNotHelp) {
  const double lambda = 2.74, k = 2.0 / 15.0;
  const Exact exact = point_source(lambda, Vec3(0.0, 0.0, 1.2));
  const Points checks = star_checks(sphere(301));
  double error[2];
  for (const int i : {0, 1}) {
    const BkmThesisProblem p = problem(sphere(i == 0 ? 350 : 700), Points(3, 0), lambda, k);
    const Data d = data_of(exact, p);
    error[i] = max_error(BkmThesisSolver(p, {1.0, cut}).solve(d.f, d.g), exact, checks) /
               max_size(exact, checks);
  }
  EXPECT_GT(error[1], 0.5 * error[0]);
  EXPECT_GT(error[1], 1e-2);
}

}  // namespace
}  // namespace knotlight
