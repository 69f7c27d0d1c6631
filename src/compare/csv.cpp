#include <cmath>

#include "compare/page.h"
#include "report/csv.h"

namespace knotlight {

std::string compare_csv(const Comparison& c) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& name, const ModelRun& run, const ModelErrors& e) {
    std::vector<std::string> row = {name, run.ran() ? "yes" : "no", run.cannot};
    for (const double value :
         {e.surface, e.picture, e.diffusion, e.transport, e.noise, e.numerical, e.energy,
          run.cost.light, run.cost.grid, run.cost.solve, run.cost.picture, run.cost.memory})
      row.push_back(run.ran() ? csv_number(value) : "");
    rows.push_back(std::move(row));
  };
  for (const ComparedModel& model : c.models)
    add(name_of(model.run.model), model.run, model.errors);
  add("converged", c.converged, c.diffusion_itself);
  return csv_text(
      {"model", "ran", "reason", "error_surface", "error_picture", "error_inside",
       "error_inside_against_photons", "noise_estimate", "numerical_estimate", "energy_imbalance",
       "seconds_light", "seconds_grid", "seconds_solve", "seconds_picture", "memory_MiB"},
      rows);
}

std::string lines_csv(const Comparison& c) {
  std::vector<std::string> header = {
      "line", "depth", "x", "y", "z", "U_d_photons", "U_d_photons_standard_error", "U_d_converged"};
  for (const ComparedModel& model : c.models)
    if (model.run.ran()) header.push_back(std::string("U_d_") + name_of(model.run.model));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t l = 0; l < c.lines.size(); ++l)
    for (std::size_t i = 0; i < c.line_cells[l].size(); ++i) {
      const LineCell& place = c.line_cells[l][i];
      const auto cell = static_cast<Eigen::Index>(place.cell);
      const auto row = static_cast<Eigen::Index>(i);
      std::vector<std::string> fields = {c.lines[l].name, csv_number(place.depth)};
      for (int a = 0; a < 3; ++a) fields.push_back(csv_number(c.truth.centers(a, cell)));
      fields.push_back(csv_number(c.truth.U_d[cell]));
      fields.push_back(csv_number(c.truth.U_d_error[cell]));
      fields.push_back(csv_number(c.converged_lines[l][row]));
      for (const ComparedModel& model : c.models)
        if (model.run.ran()) fields.push_back(csv_number(model.lines[l][row]));
      rows.push_back(std::move(fields));
    }
  return csv_text(header, rows);
}

std::string budgets_csv(const Comparison& c) {
  std::vector<std::vector<std::string>> rows;
  for (const ComparedModel& model : c.models)
    for (const BudgetPoint& point : model.budgets)
      rows.push_back({name_of(model.run.model), csv_number(point.budget), csv_number(point.seconds),
                      csv_number(point.error)});
  return csv_text({"model", "budget", "seconds", "error_surface"}, rows);
}

}  // namespace knotlight
