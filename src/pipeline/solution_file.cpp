#include "pipeline/solution_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/errors.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "pipeline/byte_archive.h"
#include "pipeline/glow.h"
#include "pipeline/scene_key.h"

namespace knotlight {

// A field on a grid that is made anew from the shape.
struct StoredField {
  double cell_size = 0.0;  // length; 0: there is no field
  Eigen::VectorXd nodes;
};

// One solved object in one channel, as the file has it.
struct StoredChannel {
  bool solved = false;
  bool on_grid = false;     // by its method; else `inside` was looked up for pictures
  double k = 0.0;           // of the equation, length
  Eigen::VectorXd surface;  // U_d at the nodes of the surface grid
  StoredField inside;       // U_d
  StoredField U_ri;
  Medium scattering;
  ChannelReport report;
  std::vector<std::string> failures;
};

struct StoredSolution {
  std::string program;
  std::vector<KeyPart> key;
  std::vector<std::vector<StoredChannel>> objects;
  Report report;
};

template <class Archive>
void members(Archive& archive, KeyPart& part) {
  archive(part.name, part.value);
}

template <class Archive>
void members(Archive& archive, Validity& v) {
  auto& [size, size_in_mean_free_paths, thickness, lambda_R, reduced_albedo, valid, reasons] = v;
  archive(size, size_in_mean_free_paths, thickness, lambda_R, reduced_albedo, valid, reasons);
}

template <class Archive>
void members(Archive& archive, ChannelReport& report) {
  auto& [lambda, k, method, photons, photon_power, entered_power, figures, numerical_error, noise,
         error_estimate, energy_imbalance, energy_imbalance_standard_error, power_in, power_leaving,
         power_absorbed] = report;
  archive(lambda, k, method, photons, photon_power, entered_power, figures, numerical_error, noise,
          error_estimate, energy_imbalance, energy_imbalance_standard_error, power_in,
          power_leaving, power_absorbed);
}

template <class Archive>
void members(Archive& archive, ObjectReport& report) {
  // The audit is `info`'s alone.
  auto& [name, source, method, validity, channels, audit] = report;
  archive(name, source, method, validity, channels);
}

template <class Archive>
void members(Archive& archive, Report& report) {
  auto& [photons_emitted, objects, failures] = report;
  archive(photons_emitted, objects, failures);
}

template <class Archive>
void members(Archive& archive, Medium& medium) {
  auto& [sigma_a, sigma_s, g, ior, emission] = medium;
  archive(sigma_a, sigma_s, g, ior, emission);
}

template <class Archive>
void members(Archive& archive, StoredField& field) {
  auto& [cell_size, nodes] = field;
  archive(cell_size, nodes);
}

template <class Archive>
void members(Archive& archive, StoredChannel& channel) {
  auto& [solved, on_grid, k, surface, inside, U_ri, scattering, report, failures] = channel;
  archive(solved, on_grid, k, surface, inside, U_ri, scattering, report, failures);
}

template <class Archive>
void members(Archive& archive, StoredSolution& solution) {
  auto& [program, key, objects, report] = solution;
  archive(program, key, objects, report);
}

namespace {

constexpr char magic[] = "knotlight solution 2\n";  // the number changes with the format
constexpr std::size_t magic_size = sizeof(magic) - 1;
constexpr char program[] = "knotlight " KNOTLIGHT_VERSION;

std::uint64_t checksum(const char* data, std::size_t size) {
  Hash hash;
  hash.bytes(data, size);
  return hash.value();
}

StoredField stored(const GridField& field) {
  return {field.geometry().h(), field.nodes()};
}

StoredChannel stored(const SolvedChannel& channel, const GlowingSurface& surface, std::size_t c) {
  StoredChannel result;
  result.solved = channel.solved;
  result.on_grid = channel.on_grid.has_value();
  result.k = channel.equation.coefficients.k;
  result.surface = surface.U_d[c];
  if (channel.on_grid)
    result.inside = stored(*channel.on_grid);
  else if (!surface.inside.channels.empty())
    result.inside = stored(surface.inside.channels[c].U_d);
  if (channel.U_ri) result.U_ri = stored(*channel.U_ri);
  result.scattering = channel.scattering;
  result.report = channel.report;
  result.failures = channel.failures;
  return result;
}

// Checked: magic, length, checksum. What is wrong is thrown as InputError without the file's name.
StoredSolution decoded(const std::string& bytes) {
  if (bytes.compare(0, magic_size, magic) != 0)
    throw InputError("is no solution file of this version");
  std::uint64_t sum = 0;
  if (bytes.size() < magic_size + sizeof(sum)) throw InputError("is cut short");
  const std::size_t end = bytes.size() - sizeof(sum);
  std::memcpy(&sum, bytes.data() + end, sizeof(sum));
  if (sum != checksum(bytes.data(), end)) throw InputError("is damaged or cut short");
  ByteReader reader(bytes.data() + magic_size, bytes.data() + end);
  StoredSolution solution;
  reader(solution);
  if (!reader.at_end()) throw InputError("holds more than a solution");
  return solution;
}

std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !in)
    throw InputError("no such file, or it cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

// The grids inside an object, each made once.
class Grids {
 public:
  Grids(const Shape& shape, const Workers& workers) : shape_(shape), workers_(workers) {}

  std::optional<GridField> field(StoredField& stored) {
    if (stored.cell_size == 0.0) return std::nullopt;
    if (!geometry_ || geometry_->h() != stored.cell_size)
      geometry_ = std::make_shared<GridGeometry>(shape_, stored.cell_size, workers_);
    if (!geometry_->ok() || geometry_->finest().dofs != stored.nodes.size())
      throw InputError("holds fields on another grid than this program's");
    return GridField(geometry_, std::move(stored.nodes));
  }

 private:
  const Shape& shape_;
  const Workers& workers_;
  std::shared_ptr<const GridGeometry> geometry_;
};

SolvedChannel restored(StoredChannel& stored, Equation equation, SourceModel source, Grids& grids) {
  SolvedChannel channel;
  channel.model = source;
  channel.solved = stored.solved;
  channel.equation = std::move(equation);
  if (channel.equation.coefficients.k != stored.k)
    throw InputError("was solved for another boundary condition than this program's");
  channel.on_grid = grids.field(stored.inside);
  channel.U_ri = grids.field(stored.U_ri);
  channel.scattering = stored.scattering;
  if (stored.on_grid && channel.on_grid)
    channel.U_d = [field = *channel.on_grid](const Points& x) { return field.values(x); };
  else
    channel.U_d = [](const Points& x) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(x.cols(), std::numeric_limits<double>::quiet_NaN());
    };
  channel.on_surface = std::move(stored.surface);
  channel.report = std::move(stored.report);
  channel.failures = std::move(stored.failures);
  return channel;
}

SolvedScene restored(StoredSolution& stored, const PreparedScene& prepared, RunContext& run) {
  const Scene& scene = prepared.scene;
  if (stored.program != program)
    throw InputError(fmt::format("was written by {}, expected {}", stored.program, program));
  const std::string difference =
      first_difference(solution_key(scene, run.options.seed), stored.key);
  if (!difference.empty())
    throw InputError(fmt::format(
        "is of another scene: {} differs, expected the same but for the camera", difference));
  const std::optional<PreparedScene> similar = similar_scene(prepared);
  const PreparedScene& as_solved = similar ? *similar : prepared;
  SolvedScene result;
  result.plan = make_plan(as_solved);
  result.report = std::move(stored.report);
  const auto channels = static_cast<std::size_t>(scene.channels);
  if (stored.objects.size() != prepared.translucent.size() ||
      result.report.objects.size() != prepared.translucent.size())
    throw InputError("holds another number of objects than its scene");
  for (std::size_t i = 0; i < prepared.translucent.size(); ++i) {
    const std::uint32_t index = prepared.translucent[i];
    const Object& object = scene.objects[index];
    if (stored.objects[i].size() != channels)
      throw InputError("holds another number of channels than its scene");
    const std::optional<FeltSurface> felt =
        solves_beyond_p1(scene.solver) ? std::optional(felt_surface(object, scene.channels))
                                       : std::nullopt;
    const Eigen::Index nodes = SurfaceGrid(object.shape).nodes().cols();
    Grids grids(object.shape, run.workers);
    result.objects.emplace_back();
    for (std::size_t c = 0; c < channels; ++c) {
      StoredChannel& channel = stored.objects[i][c];
      if (channel.surface.size() != nodes)
        throw InputError("holds values at other places of the surface than this program's");
      if (channel.solved && channel.inside.cell_size == 0.0 &&
          chosen_exitance(scene.solver) == Exitance::gather)
        throw InputError(fmt::format(
            "has nothing from inside object '{}', expected one saved with solver.exitance gather",
            object.name));
      result.objects.back().push_back(
          restored(channel,
                   equation_for(as_solved.scene, index, static_cast<int>(c), result.plan.source,
                                felt ? &*felt : nullptr),
                   result.plan.source, grids));
    }
  }
  return result;
}

}  // namespace

void write_solution(const std::string& path, const PreparedScene& prepared,
                    const SolvedScene& solved, const GlowingSurfaces& surfaces,
                    const RunContext& run) {
  StoredSolution solution{
      program, solution_key(prepared.scene, run.options.seed), {}, solved.report};
  for (std::size_t i = 0; i < solved.objects.size(); ++i) {
    solution.objects.emplace_back();
    for (std::size_t c = 0; c < solved.objects[i].size(); ++c)
      solution.objects.back().push_back(
          stored(solved.objects[i][c], *surfaces[prepared.translucent[i]], c));
  }
  ByteWriter writer;
  writer.bytes() = magic;
  writer(solution);
  std::uint64_t sum = checksum(writer.bytes().data(), writer.bytes().size());
  writer(sum);
  write_text_file(path, writer.bytes());
}

SolvedScene read_solution(const std::string& path, const PreparedScene& prepared, RunContext& run) {
  const Stage stage(run.stages, "solution", 0);
  try {
    StoredSolution solution = decoded(file_bytes(path));
    return restored(solution, prepared, run);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace knotlight
