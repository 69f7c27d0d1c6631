#include "pipeline/solve_lbkm.h"

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
// Two rounds that leave more than this of the residual were not worth it: what is left is not
// smooth (facets, sharp edges), and splitting patches will not resolve it.
constexpr double worth_splitting = 0.85;
// The patches split are those with the largest misfits that together make up this share of the
// squared misfit of all [Dör96].
constexpr double share_split = 0.7;

HomogeneousPart part(const LocalField& field, double k) {
  return {[field](const Vec3& x) { return field.value(x); },
          [field, k](const Vec3& x, const Vec3& n) { return field.robin(x, n, k); }};
}

PatchTreeOptions first_patches(const ChannelProblem& p) {
  PatchTreeOptions options;
  options.most_patches = most_patches;
  const double lambda = p.coefficients.lambda;
  if (lambda == 0.0) return options;
  const double affordable =
      std::sqrt(surface_area(p.shape) / (first_share * static_cast<double>(most_patches)));
  options.widest_at_surface = std::max(widest_at_surface / lambda, affordable);
  options.widest = std::max(widest / lambda, affordable);
  return options;
}

struct LocalFactors {
  std::shared_ptr<const SpreadKnots> knots;
  std::shared_ptr<const PatchTree> tree;
  LocalBkmSolver solver;
};
using SharedLocalFactors = std::shared_ptr<const LocalFactors>;

// On a tree as it is split, without patches yet.
SharedLocalFactors factor(std::shared_ptr<const SpreadKnots> knots,
                          const std::shared_ptr<PatchTree>& tree, const BodyQueries& body,
                          const ChannelProblem& p) {
  tree->make_patches(body, p.workers);
  return std::make_shared<const LocalFactors>(LocalFactors{
      std::move(knots), tree,
      LocalBkmSolver(tree, body, p.coefficients.lambda, p.coefficients.k, {}, p.workers)});
}

SharedLocalFactors first_factors(const BodyQueries& body, const ChannelProblem& p) {
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
    const SurfaceSamples at{knots_.positions(Eigen::all, fresh), knots_.normals(Eigen::all, fresh)};
    const BoundaryData data =
        boundary_data(problem_, particular_.evaluate(at.positions, &at.normals, problem_.workers),
                      at, problem_.seed + 8 * count);
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
    if (squared[a] != squared[b]) return squared[a] > squared[b];
    return a < b;
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

// What the patches leave between each other next to the surface: rms over it, W/(length^2 sr).
double jumps_at_surface(const PatchTree& tree, const LocalMisfit& misfit) {
  double squares = 0.0, areas = 0.0;
  for (std::size_t i = 0; i < tree.patches().size(); ++i) {
    const Patch& patch = tree.patches()[i];
    const double area = patch.knot_area * static_cast<double>(patch.knots.size());
    squares += area * std::pow(misfit.joints[static_cast<Eigen::Index>(i)], 2);
    areas += area;
  }
  return areas > 0.0 ? std::sqrt(squares / areas) : 0.0;
}

// One set of patches tried.
struct LocalRound {
  ChannelSolution solution;
  LocalMisfit misfit;
  double residual;
};

LocalRound solve_on(const LocalFactors& factors, KnotData& data, const BodyQueries& body,
                    const BoundaryStart& start, const ChannelProblem& p) {
  const PatchTree& tree = *factors.tree;
  const LocalBkmSolver& solver = factors.solver;
  const double k = p.coefficients.k;
  const std::vector<Eigen::Index> knots = solver.knots_used();
  data.evaluate(knots);
  const LocalSolution halves[2] = {solver.solve(data.g[0], p.workers),
                                   solver.solve(data.g[1], p.workers)};
  const BoundaryVerdict verdict = judge_boundary(
      p, start.checks,
      {part(solver.field(halves[0], body), k), part(solver.field(halves[1], body), k)});
  LocalSolution mean = halves[0];
  mean.beta = 0.5 * (halves[0].beta + halves[1].beta);
  LocalRound round{
      boundary_solution(p, start.particular, verdict, part(solver.field(mean, body), k)),
      solver.misfit(halves[0], data.g[0], halves[1], data.g[1], p.workers), verdict.robin_residual};
  const double jumps = relative(jumps_at_surface(tree, round.misfit), verdict.scale);
  round.solution.numerical_error += jumps;
  round.solution.method = Method::lbkm;
  if (!halves[0].converged || !halves[1].converged)
    round.solution.failures.push_back("the iteration over the patches did not converge");
  round.solution.figures.insert(
      round.solution.figures.end(),
      {{"patches", static_cast<double>(tree.patches().size())},
       {"unknowns", static_cast<double>(solver.unknowns())},
       {"boundary_knots", static_cast<double>(knots.size())},
       {"iterations", static_cast<double>(halves[0].iterations)},
       {"patch_jumps", jumps},
       {"largest_coefficient", relative(mean.beta.cwiseAbs().maxCoeff(), verdict.scale)}});
  return round;
}

}  // namespace

ChannelSolution solve_by_lbkm(const ChannelProblem& p, const BoundaryStart& start) {
  const BodyQueries body = body_queries(p);
  const FactorCache::Key key = p.factor_key(Method::lbkm);
  const auto kept = p.factors.find<KeptFactors<LocalFactors>>(key);
  SharedLocalFactors factors = kept ? kept->factors : first_factors(body, p);
  KnotData data(p, *start.particular, *factors->knots);
  const double wanted = residual_wanted(p);

  LocalRound best = solve_on(*factors, data, body, start, p);
  if (kept && kept->serve(best.residual, wanted)) return best.solution;
  SharedLocalFactors best_factors = factors;
  std::vector<double> residuals{best.residual};
  LocalMisfit misfit = best.misfit;
  for (int round = 2; round <= most_rounds && residuals.back() > wanted; ++round) {
    const PatchTree& tree = *factors->tree;
    const std::vector<std::size_t> leaves = leaves_to_split(tree, misfit);
    if (leaves.empty() || tree.patches().size() + 4 * leaves.size() > most_patches) break;
    // The best field so far keeps its tree as it is.
    auto finer = std::make_shared<PatchTree>(tree);
    for (const std::size_t leaf : leaves) finer->split(leaf);
    factors = factor(factors->knots, finer, body, p);
    LocalRound next = solve_on(*factors, data, body, start, p);
    misfit = next.misfit;
    residuals.push_back(next.residual);
    if (next.residual < best.residual) {
      best = std::move(next);
      best_factors = factors;
    }
    if (round > 2 && residuals.back() > worth_splitting * residuals[residuals.size() - 3]) break;
  }
  p.factors.put(key, std::make_shared<const KeptFactors<LocalFactors>>(
                         KeptFactors<LocalFactors>{best_factors, best.residual}));
  best.solution.figures.emplace_back("rounds", static_cast<double>(residuals.size()));
  return best.solution;
}

}  // namespace knotlight
