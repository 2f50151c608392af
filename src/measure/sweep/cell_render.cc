#include "src/measure/sweep/cell_render.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "kernels/simd/target.h"
#include "src/base/stat/interval.h"
#include "src/render/estimate/estimate.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/memory.h"
#include "src/render/job/output.h"
#include "src/render/job/saving.h"
#include "src/scene/compile/compile.h"
#include "src/vocabulary/strategy/strategy_text.h"

namespace lanelight {
namespace {

// Axes on which a compiled scene depends; threads and target change the time it takes.
constexpr Axis kCompiled[] = {Axis::kScene, Axis::kResolution, Axis::kMaxDepth,
                              Axis::kBuild, Axis::kTarget,     Axis::kThreads};

// Cells with the same key share BVHs.
std::string TreeKeyOf(const AxisValues& values) {
  return Get(values, Axis::kScene).value_or("") + "\n" +
         Get(values, Axis::kBuild).value_or("");
}

namespace fs = std::filesystem;

// Samples per pixel of the shortest probe.
constexpr std::uint64_t kProbeSamples = 4;
constexpr std::size_t kTimedProbes = 3;

// Returns the wall time of a sample: the median processor time, which excludes other
// programs, by the smallest ratio of wall to processor time.
double SampleSeconds(const std::vector<RunResult>& timed) {
  std::vector<double> cpu;
  double ratio = std::numeric_limits<double>::infinity();
  for (const RunResult& r : timed) {
    cpu.push_back(r.cpu_seconds / double(std::max<std::uint64_t>(1, r.samples)));
    ratio = std::min(ratio, r.seconds / std::max(r.cpu_seconds, 1e-9));
  }
  return stat::Median(std::move(cpu)) * ratio;
}

// Returns tiles of at most 32 x 32 pixels in a grid of 8 x 8 over the image.
std::vector<PixelRect> EvenlySpacedWindows(const PixelRect& image) {
  constexpr int kSide = 32, kGrid = 8;
  const int width = std::min(kSide, std::max(1, image.width() / kGrid));
  const int height = std::min(kSide, std::max(1, image.height() / kGrid));
  const int columns = std::min(kGrid, image.width() / width);
  const int rows = std::min(kGrid, image.height() / height);
  std::vector<PixelRect> windows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x =
          image.x0 + (image.width() - width) * column / std::max(1, columns - 1);
      const int y = image.y0 + (image.height() - height) * row / std::max(1, rows - 1);
      windows.push_back({x, y, x + width, y + height});
    }
  }
  return windows;
}

// Returns the size of the file of such an image.
double FileBytes(const FilmAccumulator& film, const Job& job, bool half) {
  const std::string path = FallbackPath("pilot.exr");
  ExrOptions options;
  options.half = half;
  WriteExr(path, film.width(), film.height(), FilmPlanes(film, job.scene.scale()),
           options);
  const double bytes = double(fs::file_size(path));
  std::error_code ignored;
  fs::remove(path, ignored);
  return bytes;
}

}  // namespace

std::string CellRenderer::SceneKey(const SweepCell& cell) const {
  std::string key;
  for (const Axis axis : kCompiled) key += Get(cell.values, axis).value_or("") + "\n";
  return key;
}

bool CellRenderer::HasTarget(const SweepCell& cell) {
  const auto& target = Get(cell.values, Axis::kTarget);
  if (!target) return true;
  const std::vector<std::string> available = AvailableTargets();
  return std::ranges::find(available, *target) != available.end();
}

// Compiles the scene; sets failure_ and no job if that fails.
void CellRenderer::Compile(const SweepCell& cell, RenderSettings settings) {
  const std::string trees = TreeKeyOf(cell.values);
  if (job_ && trees == bvh_key_) settings.cached_bvh = CachedBvhOf(*job_->scene.compiled);
  bvh_key_ = trees;
  job_.reset();  // frees memory before the next is built
  failure_.clear();
  settings.seed.reset();  // cells differ in their seeds
  for (const auto& [name, places] : sweep_.places) {
    settings.compared.push_back(StrategyNamed(name, {}, {}));
  }
  try {
    Job job = PrepareJob(sweep_.ScenePath(cell), settings);
    CheckOutputPaths(outputs_, job.loaded->files);
    job_ = std::move(job);
  } catch (const WouldOverwrite&) {
    throw;
  } catch (const InputError& error) {
    failure_ = error.what();
  }
}

Job CellRenderer::Prepare(const SweepCell& cell) {
  RenderSettings settings = sweep_.settings.render;
  ApplyValues(cell.values, settings);
  if (const std::string key = SceneKey(cell); key != key_) {
    key_ = key;
    Compile(cell, settings);
  }
  // All cells of a broken scene fail; only the first takes the time.
  if (!job_) throw std::runtime_error(failure_);
  const Strategy strategy =
      StrategyNamed(Get(cell.values, Axis::kStrategy).value_or(kSceneStrategyName), {},
                    job_->scene.strategy);
  CheckFilmFits(job_->window, LayersOf(settings, job_->loaded->description.film),
                strategy, PhysicalMemory());
  return WithStrategy(WithAmount(*job_, settings), strategy);
}

Rendering CellRenderer::Render(const SweepCell& cell, const std::string& folder,
                               const RenderHooks& hooks) {
  const Job job = Prepare(cell);
  RenderTargets targets;
  targets.image = sweep_.settings.render.image;
  targets.exr = folder + "/image.exr";
  if (targets.image.png) targets.png = folder + "/image.png";
  targets.json = "-";
  targets.keeps_others = false;  // the folder has images of this cell only
  targets.checkpoint.path = folder + "/state";
  targets.checkpoint.resume = Resume::kIfAny;
  targets.checkpoint.finished = false;
  return RenderToFiles(job, sweep_.ScenePath(cell), targets, hooks);
}

// Returns the job without light subpaths, which windows of the image do not support.
Job WithoutLightPaths(const Job& job) {
  Strategy strategy = job.scene.strategy;
  if (strategy.light_paths == LightPaths::kNone) return job;
  strategy.light_paths = LightPaths::kNone;
  return WithStrategy(job, strategy);
}

ProbeRender RenderProbe(const Job& whole, double seconds, bool half) {
  const Job job = WithoutLightPaths(whole);
  const std::vector<PixelRect> windows = EvenlySpacedWindows(job.window);
  const int width = windows.front().width() * int(windows.size());
  const int height = windows.front().height();
  ProbeRender probe;
  probe.pixels = double(job.window.pixels());
  probe.spp = std::uint64_t(job.loaded->description.sampler.spp);
  probe.load_seconds = job.loaded->load_seconds;
  probe.build_seconds = job.loaded->build_seconds;
  RunOptions options;
  options.windows = windows;
  options.seed = job.seed;
  options.threads = job.settings.threads;
  // The first renders fill caches; the last ones measure.
  Job windowed = job;
  windowed.window = {0, 0, width, height};
  std::vector<RunResult> timed;
  for (options.spp = kProbeSamples;;) {
    FilmAccumulator film = MakeFilm(windowed);
    const RunResult result = Run(job.scene, job.plan, options, film);
    const bool longer = 4 * kTimedProbes * result.seconds < seconds;
    if (timed.empty() && longer && options.spp < 1024) {
      options.spp *= 4;
      continue;
    }
    timed.push_back(result);
    if (timed.size() < kTimedProbes) continue;
    probe.sample_seconds = SampleSeconds(timed);
    const ErrorEstimate error = EstimateError(film);
    if (error.available) {
      probe.relmse = error.relmse.value * double(options.spp);
      probe.mse = error.rmse.value * error.rmse.value * double(options.spp);
    }
    probe.bytes_per_pixel =
        FileBytes(film, job, half) / double(film.width()) / film.height();
    return probe;
  }
}

}  // namespace lanelight
