#include "src/wavefront/tasks.h"

#include <algorithm>
#include <utility>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/prepare/path_values.h"
#include "src/scene/rendered_pixels.h"
#include "src/wavefront/copies.h"
#include "src/wavefront/profile.h"

namespace lanelight {
namespace {

// Samples of a pixel in adjacent slots: their rays share more of the scene than those of
// neighbouring pixels.
constexpr std::uint32_t kSamplesTogether = 16;

// Between waves: what scattered is intersected next; everything else is consumed.
void StartWave(Wave& wave) {
  std::swap(wave.queue(QueueId::kActive), wave.queue(QueueId::kScattered));
  for (int i = 0; i < kNumQueues; ++i) {
    const QueueId id = static_cast<QueueId>(i);
    if (id != QueueId::kFree && id != QueueId::kActive) wave.queues[i].size = 0;
  }
}

}  // namespace

void Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, StageClock* clock) {
  wavefront.Reset();
  Wave& wave = wavefront.wave();
  wave.work = work;
  wave.buffer = buffer;
  if (clock) {
    clock->FinishPart(TaskPart::kSetUp, std::uint64_t{work.num_pixels} * work.samples);
  }
  while (!wave.work.Done() || wave.queue(QueueId::kScattered).size > 0) {
    StartWave(wave);
    if (clock) clock->StartWave();
    for (std::size_t i = 0; i < plan.stages.size(); ++i) {
      const PlannedStage& planned = plan.stages[i];
      if (wave.queue(planned.stage.input).size == 0) continue;
      wave.lanes = {};
      planned.kernel(wave);
      if (clock) clock->Finish(i, wave.lanes.items, wave.lanes.vectors);
    }
  }
}

Tasks::Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, std::uint64_t planned_spp)
    : scene_(scene), plan_(plan), run_(run), options_(options) {
  const PixelRect pixels = RenderedPixels(scene.film);
  pixel_count_ = pixels.pixels();
  UseTiles(pixels, planned_spp);
  // A pair must not straddle two tasks.
  if (scene.strategy.pairs == Pairs::kAntithetic)
    partition_.samples += partition_.samples & 1;
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
    pixel_count_ += w.pixels();
  }
}

// Where the pixels of a tile lie in the film.
PixelRect Tasks::Place(std::size_t tile) const {
  const PixelRect& t = partition_.tiles[tile];
  if (options_.windows.empty()) return t;
  const int x = static_cast<int>(tile) * t.width();
  return {x, 0, x + t.width(), t.height()};
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
                     std::uint32_t per_task, TaskWatcher& watcher, Films& films) {
  per_task_ = per_task;
  const std::uint64_t chunks = (limit - first_sample + per_task_ - 1) / per_task_;
  if (chunks > 1) {
    return RunRoundInChunks(first_sample, limit, static_cast<std::uint32_t>(chunks),
                            watcher, films);
  }
  ParallelFor(partition_.tiles.size(), [&](std::size_t tile) {
    if (watcher.Stopped()) return;
    TaskSamples& out = ThreadWorkspace().samples;
    RunTask(partition_.tiles[tile], first_sample, limit, out);
    watcher.TaskDone();
    Merge(tile, out, films);
  });
}

void Tasks::RunRoundInChunks(std::uint64_t first_sample, std::uint64_t limit,
                             std::uint32_t chunks, TaskWatcher& watcher, Films& films) {
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
      Merge(tile, buffers_[tile * chunks + c], films);
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
  const std::size_t size =
      std::size_t{rows} * static_cast<std::size_t>(run_.planes.count());
  if (out.values.size() < size) out.values.resize(size);
  // A sample that has not split leaves the rows of its further copies alone.
  if (splits) std::fill_n(out.values.begin(), size, 0.0f);
  Drive(space.wavefront, plan_, work, {out.values.data(), rows}, clock);
  if (splits) {
    FoldCopies(out.values.data(), rows, run_.planes);
    if (clock) clock->FinishPart(TaskPart::kCopies, stride);
  }
  if (clock) clock->EndTask();
  samples_ += stride;
}

void Tasks::Merge(std::size_t tile, TaskSamples& task, Films& films) {
  const PixelRect place = Place(tile);
  // Row length behind the indices of the film's pixels.
  const int width = options_.windows.empty()
                        ? scene_.film.width
                        : place.width() * static_cast<int>(options_.windows.size());
  Workspace& space = ThreadWorkspace();
  StageClock* const clock = space.Clock();
  if (clock) clock->StartTask();
  TilePixels(place, width, &space.pixels);
  films.Add({place, space.pixels, width, task.values.data(), task.count});
  if (!clock) return;
  clock->FinishPart(TaskPart::kFilm, space.pixels.size() * task.count);
  clock->EndTask();
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
