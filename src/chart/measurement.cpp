#include "chart/measurement.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "core/errors.h"
#include "report/csv.h"

namespace knotlight {
namespace {

constexpr std::array<double Measurement::*, 5> costs = {
    &Measurement::field_seconds, &Measurement::picture_seconds, &Measurement::wall_seconds,
    &Measurement::memory, &Measurement::estimate};
constexpr std::array<ErrorParts Measurement::*, 2> errors = {&Measurement::field,
                                                             &Measurement::picture};
constexpr std::array<double ErrorParts::*, 4> parts = {&ErrorParts::error, &ErrorParts::noise,
                                                       &ErrorParts::numerical, &ErrorParts::model};

const std::vector<std::string> header = {"line",
                                         "setting",
                                         "level",
                                         "not_trusted",
                                         "field_cpu_seconds",
                                         "picture_cpu_seconds",
                                         "picture_wall_seconds",
                                         "memory_MiB",
                                         "own_error_estimate",
                                         "field_error",
                                         "field_noise",
                                         "field_numerical",
                                         "field_model",
                                         "picture_error",
                                         "picture_noise",
                                         "picture_numerical",
                                         "picture_model"};

std::vector<std::string> row_of(const Measurement& m) {
  std::vector<std::string> row = {m.line, m.setting, fmt::format("{}", m.level), m.failed};
  for (const auto cost : costs) row.push_back(csv_number(m.*cost));
  for (const auto error : errors)
    for (const auto part : parts) row.push_back(csv_number((m.*error).*part));
  return row;
}

double number(const std::string& text, const std::string& where) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0')
    throw InputError(fmt::format("{}: '{}' is not a number, expected one", where, text));
  return value;
}

}  // namespace

std::string measurements_csv(const std::vector<Measurement>& measurements) {
  std::vector<std::vector<std::string>> rows;
  for (const Measurement& m : measurements) rows.push_back(row_of(m));
  return csv_text(header, rows);
}

std::vector<Measurement> read_measurements(const std::string& path) {
  const std::vector<std::vector<std::string>> rows = read_csv(path);
  if (rows.empty() || rows.front() != header)
    throw InputError(path +
                     ":1: not a table of measurements of this version, expected one or none");
  std::vector<Measurement> all;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string where = fmt::format("{}: row {}", path, i);
    if (rows[i].size() != header.size())
      throw InputError(
          fmt::format("{}: has {} fields, expected {}", where, rows[i].size(), header.size()));
    auto field = rows[i].begin();
    Measurement m;
    m.line = *field++;
    m.setting = *field++;
    m.level = static_cast<int>(number(*field++, where));
    m.failed = *field++;
    for (const auto cost : costs) m.*cost = number(*field++, where);
    for (const auto error : errors)
      for (const auto part : parts) (m.*error).*part = number(*field++, where);
    all.push_back(std::move(m));
  }
  return all;
}

}  // namespace knotlight
