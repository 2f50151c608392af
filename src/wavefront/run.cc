#include "src/wavefront/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <utility>

#include "kernels/simd/target.h"
#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/image/regression_film.h"
#include "src/strategy/tables.h"
#include "src/wavefront/copies.h"
#include "src/wavefront/drive.h"
#include "src/wavefront/pilot.h"
#include "src/wavefront/pilot_pass.h"
#include "src/wavefront/profile.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/tiles.h"
#include "src/wavefront/workspace.h"

namespace lanelight {

namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Runner {
 public:
  Runner(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
         FilmAccumulator& film)
      : scene_(scene),
        plan_(plan),
        options_(options),
        film_(film),
        tables_(MakeStrategyTables(scene)) {
    if (OpenEnded()) film_.Regroup(FirstGroupSize(scene.strategy));
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
    const std::uint64_t limit = options_.spp > 0 ? options_.spp : kMostSamplesPerPixel;
    if (options_.seconds > 0) pace_.emplace(options_.seconds, PaceTasks());
    // The first look chooses the groups, the later ones ask whether to go on.
    std::uint64_t next_look = OpenEnded() ? FirstSamples() : limit;
    while (done_ < limit && !Stopped() && !reached_) {
      const Round round = NextRound();
      const std::uint64_t end = std::min({limit, next_look, done_ + round.samples()});
      const Clock::time_point begin = Clock::now();
      RunRound(done_, end, round);
      const std::uint64_t taken = end - std::exchange(done_, end);
      if (Stopped()) break;  // perhaps within the round
      if (pace_) pace_->Took(taken, Since(begin));
      if (pace_ && fit_seconds_ == 0 && 2 * Since(start_) > options_.seconds) TimeFit();
      if (done_ == next_look || (done_ == limit && options_.samples_needed)) {
        next_look = Look(next_look);
      }
    }
    return Result(limit);
  }

 private:
  // Pilot passes; the image may then be rendered with a simpler roulette.
  void PreparePaths() {
    PilotOptions options;
    options.planned_samples =
        options_.planned_samples > 0
            ? options_.planned_samples
            : pixel_count_ * (OpenEnded() ? kOpenEndedSpp : options_.spp);
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
    RunParameters run = MakeRunParameters(scene_, plan_, film_.group_size());
    run.seed = static_cast<std::uint32_t>(options_.seed ^ (options_.seed >> 32));
    run.spp = static_cast<std::uint32_t>(options_.spp);
    run.tables = &tables_;
    return run;
  }

  void UseTiles(const PixelRect& pixels) {
    const std::uint64_t spp = PlannedSpp();
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

  bool OpenEnded() const { return options_.seconds > 0 || options_.samples_needed; }

  std::uint64_t PlannedSpp() const {
    return OpenEnded() || options_.spp == 0 ? kOpenEndedSpp : options_.spp;
  }

  // Two groups show how much samples differ; a time budget only asks what they cost.
  std::uint64_t FirstSamples() const {
    const std::uint64_t group = FirstGroupSize(scene_.strategy);
    return std::min<std::uint64_t>(kMostSamplesPerPixel,
                                   options_.samples_needed ? 2 * group : group);
  }

  // Asks how many samples are needed, and returns when to ask again.
  std::uint64_t Look(std::uint64_t look) {
    double predicted = pace_ ? double(done_) + pace_->Reach(Since(start_)) : INFINITY;
    double needed = INFINITY;
    if (options_.samples_needed) {
      film_.FitControl();
      needed = options_.samples_needed(done_);
      ++looks_;
    }
    if (done_ < look || done_ > FirstSamples()) {
      reached_ = needed <= double(done_);
      needed_ = needed;
      return NextLook(done_, needed, film_.group_size());
    }
    // Stratification may need fewer samples than these first ones promise.
    constexpr double kGain = 4;
    predicted = std::min(predicted, needed / kGain);
    if (options_.spp > 0) predicted = std::min(predicted, double(options_.spp));
    Regroup(ChooseGroupSize(scene_.strategy, predicted, done_));
    return options_.samples_needed ? FirstLook(film_.group_size()) : kMostSamplesPerPixel;
  }

  void Regroup(std::uint32_t group_size) {
    if (group_size == film_.group_size()) return;
    film_.Regroup(group_size);
    if (regression_) regression_->Regroup(group_size);
    run_ = Parameters();
    // Groups are numbered anew: with the same seed the randomisation of a first small
    // group would come again, and that of two groups must never be the same.
    run_.seed ^= 0x9e3779b9u;
  }

  void TimeFit() {
    const Clock::time_point begin = Clock::now();
    film_.FitControl();
    fit_seconds_ = Since(begin);
  }

  bool Interrupted() const {
    return options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed);
  }
  bool OutOfTime() const {
    // The first round always ends: an image with unsampled pixels is no image.
    return options_.seconds > 0 && done_ > 0 &&
           Since(start_) >= options_.seconds - fit_seconds_;
  }
  bool Stopped() const { return Interrupted() || OutOfTime(); }

  Pace::Tasks PaceTasks() const {
    Pace::Tasks tasks;
    tasks.tiles = partition_.tiles.size();
    tasks.threads = MaxThreads();
    tasks.most = {partition_.samples, static_cast<std::uint32_t>(ChunksPerRound())};
    tasks.unit = scene_.strategy.pairs == Pairs::kAntithetic ? 2 : 1;
    return tasks;
  }

  Round NextRound() const {
    if (pace_) return pace_->Next(Since(start_));
    return {partition_.samples, static_cast<std::uint32_t>(ChunksPerRound())};
  }

  // Several sample ranges of the same tile run at once only where there are too few tiles
  // for the threads; they are merged in order, so the image does not depend on it.
  std::uint64_t ChunksPerRound() const {
    const std::uint64_t wanted = 8 * static_cast<std::uint64_t>(MaxThreads());
    return std::max<std::uint64_t>(1, wanted / partition_.tiles.size());
  }

  // The samples [first_sample, limit) of every pixel.
  void RunRound(std::uint64_t first_sample, std::uint64_t limit, const Round& round) {
    per_task_ = round.per_task;
    const std::uint64_t chunks = (limit - first_sample + per_task_ - 1) / per_task_;
    if (chunks > 1) {
      return RunRoundInChunks(first_sample, limit, static_cast<std::uint32_t>(chunks));
    }
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
      RunTask(partition_.tiles[task / chunks], first_sample + task % chunks * per_task_,
              limit, out);
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
        std::min<std::uint64_t>(per_task_, limit - first_sample));
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
    // Errors fall like 1 / samples, so samples are in proportion to the time it takes.
    const double by_need = double(samples_) / (double(pixel_count_) * needed_);
    progress.fraction = std::min(1.0, std::max({by_samples, by_time, by_need}));
    options_.on_progress(progress);
  }

  StopReason Reason(std::uint64_t limit) const {
    if (reached_) return StopReason::kTarget;
    // Only what has left samples out counts: a signal may come after the last one.
    if (samples_ == pixel_count_ * limit) return StopReason::kSamples;
    return Interrupted() ? StopReason::kInterrupted : StopReason::kTime;
  }

  RunResult Result(std::uint64_t limit) {
    RunResult result;
    film_.FitControl();
    result.seconds = Since(start_);
    result.samples = samples_;
    result.stop_reason = Reason(limit);
    result.stopped_early = result.stop_reason == StopReason::kInterrupted;
    result.group_size = film_.group_size();
    result.looks = looks_;
    result.pilot_seconds = pilot_seconds_;
    result.pilot_samples = pilot_.samples;
    result.pilot_rays = pilot_.rays;
    result.pilot_note = pilot_.note;
    result.roulette = plan_.options.roulette.value_or(scene_.strategy.roulette);
    result.control = regression_ ? regression_->Report() : film_.Control();
    result.stages = EmptyProfiles(plan_);
    for (const auto& space : workspaces_) {
      if (space) AddCounts(space->wavefront, space->counters, result);
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
  std::optional<Pace> pace_;    // with a time budget
  std::uint64_t done_ = 0;      // samples per pixel, of rounds
  std::uint32_t per_task_ = 1;  // of the current round
  double needed_ = INFINITY;    // samples per pixel, by the last look
  bool reached_ = false;        // no more are needed
  int looks_ = 0;
  double fit_seconds_ = 0;  // that the last step takes
  std::vector<std::unique_ptr<Workspace>> workspaces_;
  std::vector<TaskSamples> buffers_;
  std::atomic<std::uint64_t> samples_{0};
  Clock::time_point start_, last_report_;
  std::mutex progress_mutex_;
};

}  // namespace

const char* Name(StopReason reason) {
  static constexpr const char* kNames[] = {"samples", "time", "target", "interrupted"};
  return kNames[static_cast<int>(reason)];
}

RunResult Run(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film) {
  LL_CHECK(options.spp > 0 || options.seconds > 0 || options.samples_needed ||
           options.stop != nullptr);
  return Runner(scene, plan, options, film).Run();
}

}  // namespace lanelight
