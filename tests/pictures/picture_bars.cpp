// How far the pictures of `render` are from path tracing, and what both cost: each scene of
// scenes/pictures rendered with default settings and by `reference`. Prints a table.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/clock.h"
#include "core/file_io.h"
#include "pipeline/reference_scene.h"
#include "pipeline/render_scene.h"
#include "scene/scene_reader.h"
#include "trace/camera_rays.h"

namespace knotlight {
namespace {

namespace fs = std::filesystem;

constexpr int block = 8;  // pixels

struct Difference {
  int blocks = 0;
  double mean_ratio = 0.0;  // of the picture over the reference
  double rms = 0.0;         // of block differences over the mean, reference noise included
  double noise = 0.0;       // of the reference's blocks alone
};

// Over the blocks whose pixels all see a translucent object at their centre.
Difference compare(const Image& picture, const LayeredImage& reference, const Scene& scene) {
  std::vector<const Shape*> shapes;
  for (const Object& object : scene.objects) shapes.push_back(&object.shape);
  const RayCaster caster(shapes);
  const CameraRays rays(scene.camera);
  const std::vector<float>& mean = reference.values("G");
  const std::vector<float>& variance = reference.values("variance.G");
  Difference result;
  double sum = 0.0, reference_sum = 0.0, squares = 0.0, noise = 0.0;
  for (int by = 0; by + block <= picture.height; by += block)
    for (int bx = 0; bx + block <= picture.width; bx += block) {
      bool covered = true;
      double ours = 0.0, theirs = 0.0, spread = 0.0;
      for (int y = by; y < by + block; ++y)
        for (int x = bx; x < bx + block; ++x) {
          const auto hit = caster.nearest(rays.ray(x + 0.5, y + 0.5));
          covered = covered && hit && scene.objects[hit->object].translucent() != nullptr;
          const auto i = static_cast<std::size_t>(y) * picture.width + x;
          ours += picture.at(x, y)[1];
          theirs += mean[i];
          spread += variance[i];
        }
      if (!covered) continue;
      result.blocks += 1;
      sum += ours;
      reference_sum += theirs;
      squares += (ours - theirs) * (ours - theirs);
      noise += spread;
    }
  const double n = result.blocks;
  result.mean_ratio = sum / reference_sum;
  result.rms = std::sqrt(squares / n) / (reference_sum / n);
  result.noise = std::sqrt(noise / n) / (reference_sum / n);
  return result;
}

int run_program(int argc, char** argv) {
  CLI::App app("pictures of `render` against path tracing");
  std::string folder = "picture_bars", only;
  double noise = 0.006;
  std::vector<std::string> settings;
  app.add_option("-o,--output", folder, "folder for pictures; references in it are used again");
  app.add_option("--only", only, "scenes whose name contains this");
  app.add_option("--noise", noise, "of the reference's blocks, relative");
  app.add_option("--set", settings, "override a scene key")->allow_extra_args(false)->take_all();
  CLI11_PARSE(app, argc, argv);
  make_output_folder(folder);
  fmt::print(
      "| scene | CPU s | blocks | mean / truth | rms of blocks | noise in it | without it | "
      "reference CPU s | for 1 % per pixel |\n|---|---|---|---|---|---|---|---|---|\n");
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(fs::path(KNOTLIGHT_ROOT) / "scenes/pictures"))
    if (entry.path().extension() == ".yaml" &&
        entry.path().stem().string().find(only) != std::string::npos)
      scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const fs::path& path : scenes) {
    const std::string name = path.stem().string();
    RunOptions options;
    options.quiet = true;
    options.overrides = settings;
    const std::string picture = (fs::path(folder) / (name + ".exr")).string();
    const std::string truth = (fs::path(folder) / (name + "_reference.exr")).string();
    Scene scene;
    const double before = cpu_seconds();
    RunContext run(options, false);
    const Report report = render_scene(path.string(), {{picture}, {}}, run, scene);
    const double ours = cpu_seconds() - before;
    double theirs = 0.0, for_1_percent = 0.0;
    // Sixteen samples tell how many are needed: a block has 64 pixels.
    for (std::uint64_t spp = 16; !fs::exists(truth);) {
      options.overrides.clear();
      RunContext tracing(options, false);
      const std::string trial = truth + ".trial.exr";
      const ReferenceSummary summary = reference_scene(path.string(), {trial}, spp, tracing);
      theirs += summary.cpu_seconds;
      for_1_percent = summary.cpu_seconds_for_1_percent();
      const double needed = static_cast<double>(spp) * std::pow(summary.noise / block / noise, 2);
      if (needed <= 1.1 * static_cast<double>(spp)) {
        fs::rename(trial, truth);
      } else {
        fs::remove(trial);
        spp = static_cast<std::uint64_t>(std::ceil(needed));
      }
    }
    const Difference d = compare(read_image(picture), read_layers(truth), scene);
    fmt::print(
        "| {} | {:.1f} | {} | {:.4f} | {:.2f} % | {:.2f} % | {:.2f} % | {:.0f} | {:.0f} |{}\n",
        name, ours, d.blocks, d.mean_ratio, 100.0 * d.rms, 100.0 * d.noise,
        100.0 * std::sqrt(std::max(0.0, d.rms * d.rms - d.noise * d.noise)), theirs, for_1_percent,
        report.failures.empty() ? "" : " not trusted");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace knotlight

int main(int argc, char** argv) {
  return knotlight::run_program(argc, argv);
}
