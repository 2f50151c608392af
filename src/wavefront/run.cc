#include "src/wavefront/run.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>

#include "kernels/simd/target.h"
#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/image/regression_film.h"
#include "src/strategy/tables.h"
#include "src/wavefront/copies.h"
#include "src/wavefront/drive.h"
#include "src/wavefront/pilot.h"
#include "src/wavefront/pilot_pass.h"
#include "src/wavefront/tiles.h"

namespace lanelight {

namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Samples of one finished task, until they are merged in order.
struct TaskSamples {
  AlignedVector<float> values;
  std::uint32_t count = 0;  // samples per pixel; 0 = not run
};

// What a thread keeps between tasks.
struct Workspace {
  Workspace(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
            bool profile)
      : wavefront(scene, plan, run), counters(profile ? plan.stages.size() : 0) {}
  Wavefront wavefront;
  std::vector<StageCounters> counters;
  std::vector<std::uint32_t> pixels;
  TaskSamples samples;
};

class Runner {
 public:
  Runner(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : scene_(scene),
        plan_(plan),
        options_(options),
        film_(film),
        tables_(MakeStrategyTables(scene)) {
    run_ = Parameters();
    const PixelRect pixels = RenderedPixels(scene.film);
    pixel_count_ = std::uint64_t(pixels.width()) * pixels.height();
    UseTiles(pixels);
    // A pair must not straddle two tasks.
    if (scene.strategy.pairs == Pairs::kAntithetic)
      partition_.samples += partition_.samples & 1;
    planes_ = kColorPlanes + (film.has_aov() ? kAovPlanes : 0);
    UseControl();
    workspaces_.resize(static_cast<std::size_t>(MaxThreads()) + 1);
  }

  RunResult Run() {
    start_ = Clock::now();
    if (plan_.features.Has(Feature::kSplitting)) PreparePaths();
    std::uint64_t done = 0;  // samples per pixel started in complete rounds
    const std::uint64_t limit = options_.spp > 0 ? options_.spp : std::uint64_t{1} << 31;
    while (done < limit && !Stopped()) {
      const std::uint64_t chunks_left =
          (limit - done + partition_.samples - 1) / partition_.samples;
      const std::uint64_t chunks = std::min(chunks_left, ChunksPerRound());
      RunRound(done, limit, static_cast<std::uint32_t>(chunks));
      done += chunks * partition_.samples;
    }
    return Result(done < limit && options_.spp > 0);
  }

 private:
  // Pilot passes; the image may then be rendered with a simpler roulette.
  void PreparePaths() {
    PilotOptions options;
    options.planned_samples =
        options_.planned_samples > 0
            ? options_.planned_samples
            : pixel_count_ * (options_.spp > 0 ? options_.spp : kOpenEndedSpp);
    options.keep_roulette = options_.keep_roulette;
    options.stop = options_.stop;
    pilot_ = RunPilot(scene_, plan_, run_, options, tables_);
    if (pilot_.roulette != scene_.strategy.roulette) {
      PlanOptions simpler = plan_.options;
      simpler.roulette = pilot_.roulette;
      plan_ = MakePlan(scene_, simpler);
      run_ = Parameters();
    }
    pilot_seconds_ = Since(start_);
  }

  // Without a sample count the partition assumes many samples.
  static constexpr std::uint64_t kOpenEndedSpp = 32;
  // Samples of a pixel in adjacent slots: their rays share more of the scene than those
  // of neighbouring pixels.
  static constexpr std::uint32_t kSamplesTogether = 16;
  static constexpr int kMostPlanes =
      kColorPlanes + kAovPlanes + kColorPlanes + RegressionFilm::kPlanes;

  RunParameters Parameters() const {
    RunParameters run;
    run.seed = static_cast<std::uint32_t>(options_.seed ^ (options_.seed >> 32));
    run.width = static_cast<std::uint32_t>(scene_.film.width);
    run.height = static_cast<std::uint32_t>(scene_.film.height);
    run.spp = static_cast<std::uint32_t>(options_.spp);
    const Strategy& strategy = scene_.strategy;
    run.points = MakePointsParameters(
        strategy.points, film_.group_size() / (strategy.pairs != Pairs::kNone ? 2 : 1));
    run.pairs = MakePairParameters(strategy);
    run.mis = MakeMisParameters(strategy);
    run.roulette = MakeRouletteParameters(strategy);
    run.control_coefficient = static_cast<float>(strategy.coefficient.value_or(1));
    run.tables = &tables_;
    run.max_depth = plan_.options.max_depth;
    run.exposure = static_cast<float>(scene_.film.imaging_ratio);
    run.features = plan_.features;
    return run;
  }

  void UseTiles(const PixelRect& pixels) {
    const std::uint64_t spp = options_.spp > 0 ? options_.spp : kOpenEndedSpp;
    const std::vector<PixelRect>& windows = options_.windows;
    if (windows.empty()) {
      partition_ = MakePartition(pixels, spp);
      return;
    }
    partition_ = MakePartition(windows.front(), spp);
    LL_CHECK_EQ(partition_.tiles.size(), 1u);
    partition_.tiles = windows;
    pixel_count_ = 0;
    for (const PixelRect& w : windows) {
      LL_CHECK(w.width() == windows[0].width() && w.height() == windows[0].height());
      pixel_count_ += std::uint64_t(w.width()) * w.height();
    }
  }

  // Where the pixels of a tile lie in the film.
  PixelRect Place(std::size_t tile) const {
    const PixelRect& t = partition_.tiles[tile];
    if (options_.windows.empty()) return t;
    const int x = static_cast<int>(tile) * t.width();
    return {x, 0, x + t.width(), t.height()};
  }

  // Control variates whose coefficients come from the samples take further planes.
  void UseControl() {
    if (plan_.features.Has(Feature::kControlDifference)) {
      film_.UseControl();
      difference_plane_ = planes_;
      planes_ += kColorPlanes;
    }
    if (!plan_.features.Has(Feature::kRegressionControl)) return;
    regression_.emplace(film_.x0(), film_.y0(), film_.width(), film_.height(),
                        film_.group_size(), scene_.strategy.coefficient.value_or(1));
    numbers_plane_ = planes_;
    planes_ += RegressionFilm::kPlanes;
  }

  bool Stopped() const {
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed))
      return true;
    // The first task of every tile always runs: an image with unsampled pixels is no
    // image.
    return options_.seconds > 0 && samples_ >= pixel_count_ &&
           Since(start_) >= options_.seconds;
  }

  // Several sample ranges of the same tile run at once only where there are too few tiles
  // for the threads; they are merged in order, so the image does not depend on it.
  std::uint64_t ChunksPerRound() const {
    const std::uint64_t wanted = 8 * static_cast<std::uint64_t>(MaxThreads());
    return std::max<std::uint64_t>(1, wanted / partition_.tiles.size());
  }

  void RunRound(std::uint64_t first_sample, std::uint64_t limit, std::uint32_t chunks) {
    if (chunks > 1) return RunRoundInChunks(first_sample, limit, chunks);
    ParallelFor(partition_.tiles.size(), [&](std::size_t tile) {
      if (Stopped()) return;
      TaskSamples& out = ThreadWorkspace().samples;
      RunTask(partition_.tiles[tile], first_sample, limit, out);
      Merge(Place(tile), out);
    });
  }

  void RunRoundInChunks(std::uint64_t first_sample, std::uint64_t limit,
                        std::uint32_t chunks) {
    const std::size_t tiles = partition_.tiles.size();
    if (buffers_.size() < tiles * chunks) buffers_.resize(tiles * chunks);
    ParallelFor(tiles * chunks, [&](std::size_t task) {
      TaskSamples& out = buffers_[task];
      out.count = 0;
      if (Stopped()) return;
      RunTask(partition_.tiles[task / chunks],
              first_sample + task % chunks * partition_.samples, limit, out);
    });
    ParallelFor(tiles, [&](std::size_t tile) {
      // Stops at the first range that did not run: later ones would leave a gap.
      for (std::uint32_t c = 0; c < chunks && buffers_[tile * chunks + c].count > 0;
           ++c) {
        Merge(Place(tile), buffers_[tile * chunks + c]);
      }
    });
  }

  Workspace& ThreadWorkspace() {
    const std::size_t thread = static_cast<std::size_t>(ThreadIndex());
    LL_CHECK_LT(thread, workspaces_.size());
    if (!workspaces_[thread]) {
      workspaces_[thread] =
          std::make_unique<Workspace>(scene_, plan_, run_, options_.profile);
    }
    return *workspaces_[thread];
  }

  void RunTask(const PixelRect& tile, std::uint64_t first_sample, std::uint64_t limit,
               TaskSamples& out) {
    Workspace& space = ThreadWorkspace();
    out.count = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(partition_.samples, limit - first_sample));
    TilePixels(tile, scene_.film.width, &space.pixels);
    TileWork work;
    work.pixels = space.pixels.data();
    work.num_pixels = static_cast<std::uint32_t>(space.pixels.size());
    work.first_sample = static_cast<std::uint32_t>(first_sample);
    work.samples = out.count;
    work.together = std::min(kSamplesTogether, plan_.wavefront);
    if (scene_.strategy.pairs == Pairs::kAntithetic) work.together &= ~1u;
    const std::uint32_t stride = work.num_pixels * out.count;
    const bool splits = plan_.features.Has(Feature::kSplitting);
    const std::uint32_t rows = stride * (splits ? kMostCopies : 1);
    const std::size_t size = std::size_t{rows} * static_cast<std::size_t>(planes_);
    if (out.values.size() < size) out.values.resize(size);
    // A sample that has not split leaves the rows of its further copies alone.
    if (splits) std::fill_n(out.values.begin(), size, 0.0f);
    Drive(space.wavefront, plan_, work, {out.values.data(), rows}, space.counters);
    if (splits) FoldCopies(out.values.data(), rows, planes_, difference_plane_);
    samples_ += stride;
    ReportProgress();
  }

  void Merge(const PixelRect& tile, TaskSamples& task) {
    // Row length behind the indices of the film's pixels.
    const int width = options_.windows.empty() ? scene_.film.width : film_.width();
    std::vector<std::uint32_t> pixels;
    TilePixels(tile, width, &pixels);
    const std::size_t stride = pixels.size() * task.count;
    if (regression_) {
      const auto num_pixels = static_cast<std::uint32_t>(pixels.size());
      regression_->Correct(
          {tile.x0, tile.y0, tile.x1, tile.y1, pixels.data(), num_pixels,
           static_cast<std::uint32_t>(width), task.values.data(), task.count},
          numbers_plane_);
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const float* planes[kMostPlanes];
      for (int p = 0; p < planes_; ++p)
        planes[p] = task.values.data() + p * stride + i * task.count;
      film_.AddSamples(static_cast<int>(pixels[i]) % width,
                       static_cast<int>(pixels[i]) / width, planes, task.count);
    }
  }

  void ReportProgress() {
    if (!options_.on_progress) return;
    std::unique_lock lock(progress_mutex_, std::try_to_lock);
    if (!lock || Since(last_report_) < 0.1) return;
    last_report_ = Clock::now();
    Progress progress;
    progress.seconds = Since(start_);
    progress.samples = samples_;
    const double by_samples =
        options_.spp > 0 ? double(samples_) / (double(pixel_count_) * options_.spp) : 0;
    const double by_time = options_.seconds > 0 ? progress.seconds / options_.seconds : 0;
    progress.fraction = std::min(1.0, std::max(by_samples, by_time));
    options_.on_progress(progress);
  }

  RunResult Result(bool stopped_early) {
    RunResult result;
    result.seconds = Since(start_);
    result.samples = samples_;
    result.stopped_early = stopped_early;
    result.pilot_seconds = pilot_seconds_;
    result.pilot_samples = pilot_.samples;
    result.pilot_rays = pilot_.rays;
    result.pilot_note = pilot_.note;
    result.roulette = plan_.options.roulette.value_or(scene_.strategy.roulette);
    film_.FitControl();
    result.control = regression_ ? regression_->Report() : film_.Control();
    for (const PlannedStage& planned : plan_.stages) {
      StageProfile profile;
      profile.name = planned.stage.name;
      for (Field f : plan_.live_fields) {
        profile.bytes_per_item +=
            4.0 * (planned.stage.reads.Has(f) + planned.stage.writes.Has(f));
      }
      result.stages.push_back(profile);
    }
    for (const auto& space : workspaces_) {
      if (!space) continue;
      const Wave& wave = space->wavefront.wave();
      result.rays_closest += wave.rays_closest;
      result.rays_shadow += wave.rays_shadow;
      result.health.nan += wave.bad.nan;
      result.health.infinite += wave.bad.infinite;
      result.health.negative += wave.bad.negative;
      result.wavefront_bytes += space->wavefront.bytes();
      for (std::size_t i = 0; i < space->counters.size(); ++i) {
        const StageCounters& c = space->counters[i];
        result.stages[i].calls += c.calls;
        result.stages[i].items += c.items;
        result.stages[i].lane_slots +=
            c.lane_slots * static_cast<std::uint64_t>(CurrentLanes());
        result.stages[i].seconds += static_cast<double>(c.nanoseconds) * 1e-9;
      }
    }
    for (const TaskSamples& buffer : buffers_) {
      result.wavefront_bytes += buffer.values.size() * sizeof(float);
    }
    return result;
  }

  const CompiledScene& scene_;
  Plan plan_;
  const RunOptions& options_;
  FilmAccumulator& film_;
  StrategyTables tables_;
  RunParameters run_;
  TilePartition partition_;
  PilotOutcome pilot_;
  double pilot_seconds_ = 0;
  int planes_ = kColorPlanes;
  int difference_plane_ = 0;  // of c=optimal, if there are such planes
  std::optional<RegressionFilm> regression_;
  int numbers_plane_ = 0;
  std::uint64_t pixel_count_ = 0;
  std::vector<std::unique_ptr<Workspace>> workspaces_;
  std::vector<TaskSamples> buffers_;
  std::atomic<std::uint64_t> samples_{0};
  Clock::time_point start_, last_report_;
  std::mutex progress_mutex_;
};

}  // namespace

RunResult Run(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.spp > 0 || options.seconds > 0 || options.stop != nullptr);
  return Runner(scene, plan, options, film).Run();
}

}  // namespace lanelight
