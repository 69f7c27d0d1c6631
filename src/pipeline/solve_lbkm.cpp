#include "pipeline/solve_lbkm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bkm/local_solver.h"
#include "pipeline/homogeneous.h"

namespace knotlight {
namespace {

// A patch resolves waves that change by a factor e over half of its width. They do so next to the
// surface; deep inside little light is left, and patches need only stay clear of overflow.
constexpr double widest_at_surface = 2.0;  // 1/lambda
constexpr double widest = 100.0;           // 1/lambda
// But the first round leaves most of the patches to be spent where misfits are.
constexpr double first_share = 0.25;
constexpr std::size_t most_patches = 12'000;   // 1 GiB
constexpr std::size_t knot_choices = 1 << 19;  // a leaf of the finest level still sees a few
constexpr int most_rounds = 12;
// The residual aimed at, as a share of the tolerance: noise takes the other half.
constexpr double residual_wanted = 0.5;
// Two rounds that leave more than this of the residual were not worth it: what is left is not
// smooth (facets, sharp edges), and splitting patches will not resolve it.
constexpr double worth_splitting = 0.85;
// The patches split are those with the largest misfits that together make up this share of the
// squared misfit of all [Dör96].
constexpr double share_split = 0.7;

HomogeneousPart part(const LocalField& field, double k) {
  return {[field](const Vec3& x) { return field.value(x); },
          [field, k](const Vec3& x, const Vec3& n) {
            return field.value(x) + k * field.gradient(x).dot(n);
          }};
}

PatchTreeOptions first_patches(const ChannelProblem& p) {
  PatchTreeOptions options;
  const double lambda = p.coefficients.lambda;
  if (lambda == 0.0) return options;
  const double affordable =
      std::sqrt(surface_area(p.shape) / (first_share * static_cast<double>(most_patches)));
  options.widest_at_surface = std::max(widest_at_surface / lambda, affordable);
  options.widest = std::max(widest / lambda, affordable);
  return options;
}

// Patches split where an earlier light needed it, factored.
struct LocalFactors {
  std::shared_ptr<const SpreadKnots> knots;
  std::shared_ptr<const PatchTree> tree;
  LocalBkmSolver solver;
};

// On a tree as it is split, without patches yet.
std::shared_ptr<const LocalFactors> factor(std::shared_ptr<const SpreadKnots> knots,
                                           std::shared_ptr<PatchTree> tree, const BodyQueries& body,
                                           const ChannelProblem& p) {
  tree->make_patches(body, p.workers);
  auto factors = std::make_shared<const LocalFactors>(LocalFactors{
      std::move(knots), tree,
      LocalBkmSolver(tree, body, p.coefficients.lambda, p.coefficients.k, {}, p.workers)});
  p.factors.put(p.factor_key(Method::lbkm), factors);
  return factors;
}

std::shared_ptr<const LocalFactors> first_factors(const BodyQueries& body,
                                                  const ChannelProblem& p) {
  if (auto kept = p.factors.find<LocalFactors>(p.factor_key(Method::lbkm))) return kept;
  auto knots =
      std::make_shared<const SpreadKnots>(spread_surface_knots(p.shape, knot_choices, p.seed));
  return factor(knots, std::make_shared<PatchTree>(knots, first_patches(p)), body, p);
}

// The Robin data at the knots, evaluated where a round needs them for the first time.
class KnotData {
 public:
  KnotData(const ChannelProblem& problem, const ParticularSolution& particular,
           const SpreadKnots& knots)
      : problem_(problem),
        particular_(particular),
        knots_(knots),
        known_(static_cast<std::size_t>(knots.positions.cols()), 0) {
    g.fill(Eigen::VectorXd::Zero(knots.positions.cols()));
  }

  void evaluate(const std::vector<Eigen::Index>& used) {
    std::vector<Eigen::Index> fresh;
    for (const Eigen::Index i : used)
      if (!known_[static_cast<std::size_t>(i)]) fresh.push_back(i);
    const Points positions = knots_.positions(Eigen::all, fresh);
    const Points normals = knots_.normals(Eigen::all, fresh);
    const BoundaryData data =
        boundary_data(problem_, particular_, positions, normals, problem_.seed + 8 * count);
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      known_[static_cast<std::size_t>(fresh[i])] = 1;
      for (std::size_t half = 0; half < 2; ++half)
        g[half][fresh[i]] = data.g[half][static_cast<Eigen::Index>(i)];
    }
    count += fresh.size();
  }

  std::array<Eigen::VectorXd, 2> g;  // of all knots; 0 where not evaluated
  std::size_t count = 0;             // evaluated

 private:
  const ChannelProblem& problem_;
  const ParticularSolution& particular_;
  const SpreadKnots& knots_;
  std::vector<char> known_;
};

// Leaves whose patches leave most of the misfit, and can be split.
std::vector<std::size_t> leaves_to_split(const PatchTree& tree, const LocalMisfit& misfit) {
  const std::vector<Patch>& patches = tree.patches();
  std::vector<double> squared(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double area = patches[i].knot_area * static_cast<double>(patches[i].knots.size());
    squared[i] = area * std::pow(misfit.boundary[row], 2) +
                 std::pow(patches[i].radius * misfit.joints[row], 2);
  }
  std::vector<std::size_t> order(patches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return squared[a] > squared[b] || (squared[a] == squared[b] && a < b);
  });
  const double all = std::accumulate(squared.begin(), squared.end(), 0.0);
  std::vector<std::size_t> leaves;
  double sum = 0.0;
  for (const std::size_t i : order) {
    if (sum >= share_split * all) break;
    sum += squared[i];
    if (tree.can_split(patches[i].leaf)) leaves.push_back(patches[i].leaf);
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

}  // namespace

ChannelSolution solve_by_lbkm(const ChannelProblem& p) {
  ChannelSolution solution;
  const double k = p.coefficients.k;
  const auto particular = std::make_shared<const ParticularSolution>(p, particular_options(p));
  const BodyQueries body = body_queries(p);
  const BoundaryChecks checks = boundary_checks(p, *particular);
  std::shared_ptr<const LocalFactors> factors = first_factors(body, p);
  KnotData data(p, *particular, *factors->knots);
  std::vector<double> residuals;  // round by round
  for (int round = 1;; ++round) {
    const PatchTree& tree = *factors->tree;
    const LocalBkmSolver& solver = factors->solver;
    data.evaluate(solver.knots_used());
    const LocalSolution halves[2] = {solver.solve(data.g[0], p.workers),
                                     solver.solve(data.g[1], p.workers)};
    const BoundaryVerdict verdict = judge_boundary(
        p, checks,
        {part(solver.field(halves[0], body), k), part(solver.field(halves[1], body), k)});
    LocalSolution mean = halves[0];
    mean.beta = 0.5 * (halves[0].beta + halves[1].beta);
    solution = boundary_solution(p, particular, verdict, part(solver.field(mean, body), k));
    solution.method = Method::lbkm;
    if (!halves[0].converged || !halves[1].converged)
      solution.failures.push_back("the iteration over the patches did not converge");
    solution.figures.insert(
        solution.figures.end(),
        {{"patches", static_cast<double>(tree.patches().size())},
         {"unknowns", static_cast<double>(solver.unknowns())},
         {"boundary_knots", static_cast<double>(data.count)},
         {"rounds", static_cast<double>(round)},
         {"iterations", static_cast<double>(halves[0].iterations)},
         {"largest_coefficient", relative(mean.beta.cwiseAbs().maxCoeff(), verdict.scale)}});
    if (!(verdict.robin_residual > residual_wanted * p.settings.tolerance) ||
        (round > 2 && verdict.robin_residual > worth_splitting * residuals.end()[-2]) ||
        round == most_rounds)
      break;
    residuals.push_back(verdict.robin_residual);
    const LocalMisfit misfit = solver.misfit(halves[0], data.g[0], halves[1], data.g[1], p.workers);
    const std::vector<std::size_t> leaves = leaves_to_split(tree, misfit);
    if (leaves.empty() || tree.patches().size() + 4 * leaves.size() > most_patches) break;
    // The field found so far keeps its tree as it is.
    auto finer = std::make_shared<PatchTree>(tree);
    for (const std::size_t leaf : leaves) finer->split(leaf);
    factors = factor(factors->knots, std::move(finer), body, p);
  }
  return solution;
}

}  // namespace knotlight
