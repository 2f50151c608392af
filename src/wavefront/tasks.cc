#include "src/wavefront/tasks.h"

#include <algorithm>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/wavefront/copies.h"
#include "src/wavefront/drive.h"
#include "src/wavefront/profile.h"
#include "src/prepare/path_values.h"

namespace lanelight {
namespace {

// Samples of a pixel in adjacent slots: their rays share more of the scene than those of
// neighbouring pixels.
constexpr std::uint32_t kSamplesTogether = 16;

}  // namespace

Tasks::Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, std::uint64_t planned_spp, FilmAccumulator& film)
    : scene_(scene), plan_(plan), run_(run), options_(options), film_(film) {
  const PixelRect pixels = RenderedPixels(scene.film);
  pixel_count_ = std::uint64_t(pixels.width()) * pixels.height();
  UseTiles(pixels, planned_spp);
  // A pair must not straddle two tasks.
  if (scene.strategy.pairs == Pairs::kAntithetic)
    partition_.samples += partition_.samples & 1;
  planes_ = kColorPlanes + (film.has_aov() ? kAovPlanes : 0);
  workspaces_.resize(static_cast<std::size_t>(MaxThreads()) + 1);
}

void Tasks::UseTiles(const PixelRect& pixels, std::uint64_t planned_spp) {
  const std::vector<PixelRect>& windows = options_.windows;
  if (windows.empty()) {
    partition_ = MakePartition(pixels, planned_spp);
    return;
  }
  partition_ = MakePartition(windows.front(), planned_spp);
  LL_CHECK_EQ(partition_.tiles.size(), 1u);
  partition_.tiles = windows;
  pixel_count_ = 0;
  for (const PixelRect& w : windows) {
    LL_CHECK(w.width() == windows[0].width() && w.height() == windows[0].height());
    pixel_count_ += std::uint64_t(w.width()) * w.height();
  }
}

// Where the pixels of a tile lie in the film.
PixelRect Tasks::Place(std::size_t tile) const {
  const PixelRect& t = partition_.tiles[tile];
  if (options_.windows.empty()) return t;
  const int x = static_cast<int>(tile) * t.width();
  return {x, 0, x + t.width(), t.height()};
}

void Tasks::UseControl() {
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

void Tasks::Regroup(std::uint32_t group_size) {
  if (regression_) regression_->Regroup(group_size);
}

Round Tasks::FullRound() const {
  // Several sample ranges of the same tile run at once only where there are too few tiles
  // for the threads; they are merged in order, so the image does not depend on it.
  const std::uint64_t wanted = 8 * static_cast<std::uint64_t>(MaxThreads());
  const std::uint64_t chunks =
      std::max<std::uint64_t>(1, wanted / partition_.tiles.size());
  return {partition_.samples, static_cast<std::uint32_t>(chunks)};
}

void Tasks::RunRound(std::uint64_t first_sample, std::uint64_t limit,
                     std::uint32_t per_task, TaskWatcher& watcher) {
  per_task_ = per_task;
  const std::uint64_t chunks = (limit - first_sample + per_task_ - 1) / per_task_;
  if (chunks > 1) {
    return RunRoundInChunks(first_sample, limit, static_cast<std::uint32_t>(chunks),
                            watcher);
  }
  ParallelFor(partition_.tiles.size(), [&](std::size_t tile) {
    if (watcher.Stopped()) return;
    TaskSamples& out = ThreadWorkspace().samples;
    RunTask(partition_.tiles[tile], first_sample, limit, out);
    watcher.TaskDone();
    Merge(Place(tile), out);
  });
}

void Tasks::RunRoundInChunks(std::uint64_t first_sample, std::uint64_t limit,
                             std::uint32_t chunks, TaskWatcher& watcher) {
  const std::size_t tiles = partition_.tiles.size();
  if (buffers_.size() < tiles * chunks) buffers_.resize(tiles * chunks);
  ParallelFor(tiles * chunks, [&](std::size_t task) {
    TaskSamples& out = buffers_[task];
    out.count = 0;
    if (watcher.Stopped()) return;
    RunTask(partition_.tiles[task / chunks], first_sample + task % chunks * per_task_,
            limit, out);
    watcher.TaskDone();
  });
  ParallelFor(tiles, [&](std::size_t tile) {
    // Stops at the first range that did not run: later ones would leave a gap.
    for (std::uint32_t c = 0; c < chunks && buffers_[tile * chunks + c].count > 0; ++c) {
      Merge(Place(tile), buffers_[tile * chunks + c]);
    }
  });
}

Workspace& Tasks::ThreadWorkspace() {
  const std::size_t thread = static_cast<std::size_t>(ThreadIndex());
  LL_CHECK_LT(thread, workspaces_.size());
  if (!workspaces_[thread]) {
    workspaces_[thread] = std::make_unique<Workspace>(scene_, plan_, run_, options_);
  }
  return *workspaces_[thread];
}

void Tasks::RunTask(const PixelRect& tile, std::uint64_t first_sample,
                    std::uint64_t limit, TaskSamples& out) {
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
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
  Drive(space.wavefront, plan_, work, {out.values.data(), rows}, clock);
  if (splits) {
    FoldCopies(out.values.data(), rows, planes_, difference_plane_);
    if (clock) clock->FinishPart(TaskPart::kCopies, stride);
  }
  if (clock) clock->EndTask();
  samples_ += stride;
}

void Tasks::Merge(const PixelRect& tile, TaskSamples& task) {
  // Row length behind the indices of the film's pixels.
  const int width = options_.windows.empty() ? scene_.film.width : film_.width();
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
  std::vector<std::uint32_t>& pixels = space.pixels;
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
  if (!clock) return;
  clock->FinishPart(TaskPart::kFilm, stride);
  clock->EndTask();
}

std::optional<ControlReport> Tasks::Control() const {
  return regression_ ? regression_->Report() : film_.Control();
}

void Tasks::AddCounts(RunResult& result) {
  for (const auto& space : workspaces_) {
    if (space) lanelight::AddCounts(space->wavefront, space->Clock(), result);
  }
  for (const TaskSamples& buffer : buffers_) {
    result.wavefront_bytes += buffer.values.size() * sizeof(float);
  }
}

}  // namespace lanelight
