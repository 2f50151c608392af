#include "src/render/schedule/thread_work.h"

#include <algorithm>
#include <utility>

#include "src/base/core/parallel.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

// Renders without a sample count are divided as if they had many samples.
std::uint64_t PlannedSpp(const RunOptions& options) {
  const bool open_ended = options.seconds > 0 || options.samples_needed;
  return open_ended || options.spp == 0 ? kTrainingSpp : options.spp;
}

}  // namespace

ThreadWork::ThreadWork(const PreparedScene& scene, const Plan& plan,
                       const RunParameters& run, const RunOptions& options, Films& films)
    : scene_(scene),
      options_(options),
      films_(films),
      runner_(scene, plan, run, options, WindowOf(films.film())) {
  UseTiles(PartitionOf(scene, options, PlannedSpp(options)));
}

void ThreadWork::UseTiles(TilePartition partition) {
  samples_per_range_ = partition.samples;
  scheduler_ = std::make_unique<Scheduler>(std::move(partition.tiles));
}

void ThreadWork::Resume(const RunCounts& counts) {
  counts_ = counts;
  rendered_samples_ = counts.samples;
  std::vector<PixelRect> tiles = scheduler_->tiles();
  if (options_.windows.empty()) DivideUnevenTiles(films_.film(), tiles);
  std::vector<TileProgress> progress;
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    const PixelRect place = PlaceInFilm(options_, tiles, tile);
    progress.push_back({tile, films_.film().Samples(place.x0, place.y0)});
  }
  scheduler_ = std::make_unique<Scheduler>(std::move(tiles));
  scheduler_->Resume(progress);
}

void ThreadWork::ShareTiles(const std::vector<PixelRect>& tiles,
                            const std::vector<TileProgress>& owned) {
  RunOptions all;
  all.tiles = tiles;
  // Ranges have the same length on all ranks.
  UseTiles(PartitionOf(scene_, all, PlannedSpp(options_)));
  scheduler_->Resume(owned);
  shared_ = true;
}

void ThreadWork::RunRound(const Round& round, TaskWatcher& watcher) {
  if (!begun_) runner_.Begin(scheduler_->tiles().size());
  begun_ = true;
  const auto threads = std::uint32_t(MaxThreads());
  const auto tiles = std::uint32_t(scheduler_->Snapshot().size());
  scheduler_->Begin(round, {std::max(1u, 8 * threads / std::max(1u, tiles)), shared_});
  ParallelFor(threads, [&](std::size_t) {
    try {
      while (const auto range = scheduler_->Next(watcher)) {
        const PixelRect& tile = scheduler_->tiles()[range->tile];
        TaskSamples& out = runner_.Samples();
        if (!runner_.Run(*range, tile, watcher, out)) return scheduler_->Cancel();
        rendered_samples_ += out.counts.samples;
        scheduler_->FinishRange(
            *range, out, [&](TaskSamples& samples) { Merge(range->tile, samples); });
        watcher.TaskDone();
      }
    } catch (...) {
      scheduler_->Cancel();
      throw;
    }
  });
}

void ThreadWork::Merge(std::size_t tile, TaskSamples& task) {
  const std::vector<PixelRect>& tiles = scheduler_->tiles();
  const PixelRect place = PlaceInFilm(options_, tiles, tile);
  runner_.Merge(place, task, films_);
  if (options_.on_tile) options_.on_tile(films_.film(), place);
  const std::lock_guard lock(counts_mutex_);
  counts_.Add(task.counts);
  if (!options_.on_task) return;
  RunCounts counts = task.counts;
  counts.cpu_seconds = task.cpu_seconds;
  options_.on_task(tiles[tile], counts);
}

void ThreadWork::AddProfile(RunResult& result) { runner_.AddCounts(result); }

}  // namespace lanelight
