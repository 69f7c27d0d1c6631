#include "pipeline/glow.h"

#include <fmt/format.h>

#include "core/errors.h"
#include "pipeline/beyond_p1.h"
#include "pipeline/solve_grid.h"

namespace knotlight {
namespace {

constexpr std::size_t nodes_per_chunk = 512;

Eigen::VectorXd evaluate(const SolvedChannel& solution, const Points& points,
                         const Workers& workers) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(points.cols());
  // The picture is written all the same, marked as not to be trusted: what could not be solved
  // stays dark in it.
  if (!solution.solved) return values;
  workers.for_chunks(static_cast<std::size_t>(points.cols()), nodes_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       const auto first = static_cast<Eigen::Index>(begin);
                       const auto count = static_cast<Eigen::Index>(end - begin);
                       values.segment(first, count) = solution.U_d(points.middleCols(first, count));
                     });
  return values;
}

// The nodes of a grid, and for those outside the object two places inside from which the field is
// continued along the normal: on the surface and as far below as the node lies above.
struct GridNodes {
  Points inner, middle;  // equal for nodes inside
};

GridNodes grid_nodes(const GridGeometry& geometry, const RayCaster& caster, std::uint32_t object,
                     const Workers& workers) {
  const Level& level = geometry.finest();
  Points nodes(3, level.dofs);
  for (const Piece& piece : level.pieces) {
    const auto cell = level.grid.position(piece.cell);
    for (int corner = 0; corner < 8; ++corner) {
      const auto offset = corner_offset(corner);
      Vec3 at;
      for (std::size_t a = 0; a < 3; ++a) at[static_cast<int>(a)] = cell[a] + offset[a];
      nodes.col(piece.dof[static_cast<std::size_t>(corner)]) =
          level.grid.origin + level.grid.h * at;
    }
  }
  GridNodes result{nodes, nodes};
  workers.for_chunks(static_cast<std::size_t>(level.dofs), nodes_per_chunk,
                     [&](std::size_t, std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) {
                         const auto column = static_cast<Eigen::Index>(i);
                         const Vec3 x = nodes.col(column);
                         if (caster.inside(x, object)) continue;
                         const Vec3 p = caster.nearest_surface_point(x, object).position;
                         result.middle.col(column) = p;
                         result.inner.col(column) =
                             caster.inside(2.0 * p - x, object) ? Vec3(2.0 * p - x) : p;
                       }
                     });
  return result;
}

}  // namespace

Exitance chosen_exitance(const SolverSettings& settings) {
  return settings.exitance.value_or(Exitance::gather);
}

void choose_for_picture(SolverSettings& settings) {
  const bool gathers = chosen_exitance(settings) == Exitance::gather;
  if (!settings.diffusion && gathers)
    settings.diffusion =
        settings.boundary == Boundary::milne ? Diffusion::asymptotic : Diffusion::p1;
}

GlowingSurfaces glowing_surfaces(const PreparedScene& prepared, const SolvedScene& solved,
                                 RunContext& run) {
  const Scene& scene = prepared.scene;
  const Exitance exitance = chosen_exitance(scene.solver);
  const auto channels = static_cast<std::size_t>(scene.channels);
  GlowingSurfaces surfaces(scene.objects.size());
  Stage stage(run.stages, "surface", prepared.translucent.size() * channels);
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const std::uint32_t index = prepared.translucent[i];
    const Object& object = scene.objects[index];
    GlowingSurface& surface = surfaces[index].emplace(SurfaceGrid(object.shape));
    surface.inside.counts_entering_light = solved.plan.source == SourceModel::boundary_flux;
    std::shared_ptr<const GridGeometry> geometry;  // for fields that are on no grid
    std::optional<GridNodes> nodes;
    for (std::size_t c = 0; c < channels; ++c) {
      const SolvedChannel& solution = solved.objects[i][c];
      surface.U_d.push_back(solution.on_surface
                                ? *solution.on_surface
                                : evaluate(solution, surface.grid.nodes(), run.workers));
      // What is met by looking for light, not by looking, is not gathered.
      surface.leaving.emplace_back(object.translucent()->ior, solution.equation.coefficients.A,
                                   exitance == Exitance::gather ? Exitance::p1 : exitance);
      if (exitance == Exitance::gather) {
        if (solution.equation.beyond_p1 && !surface.inside.surface)
          surface.inside.surface = felt_surface(object, scene.channels);
        GridField U_d;
        if (solution.on_grid) {
          U_d = *solution.on_grid;
        } else {
          if (!nodes) {
            geometry = resolving_geometry(object, scene.channels, scene.solver, run.workers);
            if (!geometry->resolved())
              throw InputError(fmt::format(
                  "object '{}': no grid resolves it ({}), expected solver.exitance p1, lambert or "
                  "mean_intensity",
                  object.name, geometry->unresolved()));
            nodes = grid_nodes(*geometry, *prepared.caster, index, run.workers);
          }
          U_d = GridField(geometry, 2.0 * evaluate(solution, nodes->middle, run.workers) -
                                        evaluate(solution, nodes->inner, run.workers));
        }
        surface.inside.channels.push_back({std::move(U_d), solution.equation.beyond_p1,
                                           solution.equation.coefficients.k, solution.scattering,
                                           solution.U_ri});
      }
      stage.advance();
    }
  }
  return surfaces;
}

}  // namespace knotlight
