#include "compare/truth.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "photon/photon_tracer.h"

namespace knotlight {
namespace {

// Photons that tell how often one interacts on average; to 1-2 %, which is all that is wanted.
constexpr std::size_t truth_pilot_photons = 10'000;
constexpr std::size_t fewest_photons = 100'000;   // else a tenth of them would fill no cell
constexpr std::size_t most_photons = 20'000'000;  // where hardly any interact
// Of a cell's edge: a line along the edges of cells passes their centres at 0.71.
constexpr double nearest_cell = 0.75;
// Cells cut by the surface hold a mean over the part inside, whose centre is elsewhere.
constexpr double whole_cell = 1.0 - 1e-6;

double interactions_per_photon(const PreparedScene& prepared, std::uint64_t seed,
                               const Workers& workers) {
  TracerOptions options;
  options.photons = truth_pilot_photons;
  options.seed = seed;
  options.orders = TracerOptions::Orders::all;
  options.store = false;
  Stages unseen(false);
  Stage stage(unseen, "pilot", options.photons);
  const TraceResult traced =
      trace_photons(prepared.scene, *prepared.caster, 0, options, workers, stage);
  double interacting = 0.0;  // W
  for (const EnergyAudit& audit : traced.audit) interacting += audit.interactions;
  return interacting / traced.emitted;
}

}  // namespace

std::string no_truth_because(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  if (scene.lights.empty()) return "the scene has no lights for photons to start from";
  for (const std::uint32_t i : prepared.translucent)
    if (scene.objects[i].translucent()->emission[0] > 0.0)
      return "object '" + scene.objects[i].name +
             "' shines by itself, and photons start from lights alone";
  if (scene.solver.similarity)
    return "with similarity the parts of the light that count as scattered and unscattered are not "
           "those of the photons";
  return "";
}

TransportTruth trace_truth(const PreparedScene& prepared, std::uint32_t object, double interactions,
                           std::uint64_t seed, RunContext& run) {
  const auto start = std::chrono::steady_clock::now();
  const Object& item = prepared.scene.objects[object];
  const FluxGrid grid = truth_grid(item);
  std::vector<FluxTally> tally = {
      FluxTally(grid, object, item.shape, item.translucent()->medium(0))};
  const bool known = no_truth_because(prepared).empty();
  TransportTruth truth;
  if (known) {
    TracerOptions options;
    options.photons = static_cast<std::size_t>(
        std::clamp(interactions / interactions_per_photon(prepared, seed, run.workers),
                   static_cast<double>(fewest_photons), static_cast<double>(most_photons)));
    options.seed = seed;
    options.orders = TracerOptions::Orders::all;
    options.store = false;
    Stage stage(run.stages, "all orders", options.photons);
    trace_photons(prepared.scene, *prepared.caster, 0, options, run.workers, stage, tally);
    truth.photons = options.photons;
  }

  truth.cell = grid.cell_size().x();
  const double whole = whole_cell * grid.cell_size().prod();
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < grid.cells(); ++i)
    if (tally[0].volume(i) >= whole) cells.push_back(i);
  const auto n = static_cast<Eigen::Index>(cells.size());
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  truth.centers.resize(3, n);
  truth.U_d.setConstant(n, nothing);
  truth.U_d_error.setConstant(n, nothing);
  truth.U_ri.setConstant(n, nothing);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t cell = cells[static_cast<std::size_t>(i)];
    truth.centers.col(i) = grid.cell_bounds(cell).center();
    if (!known) continue;
    const Flux scattered = tally[0].flux(cell, FluxOrder::scattered, FluxEstimator::track_lengths);
    truth.U_d[i] = scattered.U;
    truth.U_d_error[i] = scattered.U_error;
    truth.U_ri[i] = tally[0].flux(cell, FluxOrder::unscattered, FluxEstimator::track_lengths).U;
  }
  truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return truth;
}

std::vector<LineCell> cells_along(const InwardLine& line, const TransportTruth& truth) {
  std::vector<LineCell> found;
  for (Eigen::Index i = 0; i < truth.centers.cols(); ++i) {
    const Vec3 offset = truth.centers.col(i) - line.start;
    const double depth = offset.dot(line.inward);
    if (depth <= 0.0 || depth >= line.length) continue;
    if ((offset - depth * line.inward).norm() <= nearest_cell * truth.cell)
      found.push_back({static_cast<std::size_t>(i), depth});
  }
  std::sort(found.begin(), found.end(),
            [](const LineCell& a, const LineCell& b) { return a.depth < b.depth; });
  return found;
}

}  // namespace knotlight
