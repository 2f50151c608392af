#include "src/wavefront/tasks.h"

#include <algorithm>
#include <utility>

#include "src/core/parallel.h"
#include "src/wavefront/partition.h"

namespace lanelight {

Tasks::Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, std::uint64_t planned_spp)
    : options_(options),
      partition_(PartitionOf(scene, options, planned_spp)),
      done_(partition_.tiles.size()),
      runner_(scene, plan, run, options) {
  for (const PixelRect& tile : partition_.tiles) pixel_count_ += tile.pixels();
}

void Tasks::GoOn(const Films& films, const RunCounts& counts) {
  counts_ = counts;
  taken_ = counts.samples;
  if (options_.windows.empty()) DivideUnevenTiles(films.film(), partition_.tiles);
  done_.resize(partition_.tiles.size());
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    const PixelRect place = PlaceInFilm(options_, partition_.tiles, tile);
    done_[tile] = films.film().Samples(place.x0, place.y0);
  }
}

std::uint64_t Tasks::Done() const {
  return *std::min_element(done_.begin(), done_.end());
}

bool Tasks::IsAt(std::uint64_t limit) const {
  return std::all_of(done_.begin(), done_.end(),
                     [&](std::uint64_t done) { return done == limit; });
}

Round Tasks::FullRound() const {
  // Several sample ranges of the same tile run at once only where there are too few tiles
  // for the threads; they are merged in order, so the image does not depend on it.
  const std::uint64_t wanted = 8 * static_cast<std::uint64_t>(MaxThreads());
  const std::uint64_t chunks =
      std::max<std::uint64_t>(1, wanted / partition_.tiles.size());
  return {partition_.samples, static_cast<std::uint32_t>(chunks)};
}

void Tasks::BeginRound(const RoundWork& work) {
  first_ = work.first;
  per_task_ = work.per_task;
  if (begun_) return;
  begun_ = true;
  runner_.Begin(partition_.tiles);
}

std::vector<TileRange> Tasks::Behind(std::uint64_t limit) const {
  std::vector<TileRange> ranges;
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    if (done_[tile] >= limit) continue;
    ranges.push_back({static_cast<std::uint32_t>(tile), done_[tile], limit,
                      partition_.tiles[tile].pixels() * (limit - done_[tile])});
  }
  return ranges;
}

RunCounts Tasks::BringOn(const TileRange& range, TaskWatcher& watcher, Films& films) {
  const std::size_t tile = range.tile;
  RunCounts counts;
  while (done_[tile] < range.end && !watcher.Stopped()) {
    TaskSamples& out = runner_.Samples();
    const std::uint64_t end = std::min(range.end, done_[tile] + per_task_);
    if (!RunTask({range.tile, done_[tile], end, 0}, watcher, out)) break;
    Merge(tile, out, films);
    counts.Add(out.counts);
    watcher.TaskDone();
  }
  return counts;
}

void Tasks::Credit(const RunCounts& counts) {
  const std::lock_guard lock(counts_mutex_);
  counts_.Add(counts);
  taken_ += counts.samples;
}

void Tasks::RunRound(const RoundWork& work, TaskWatcher& watcher, Films& films) {
  BeginRound(work);
  const std::uint64_t limit = work.limit;
  // Where there are few tiles for the threads, ranges of samples are rendered at once,
  // and wait in memory until it is their turn.
  if (limit - Done() > per_task_) return RunRoundInChunks(limit, watcher, films);
  ParallelFor(partition_.tiles.size(), [&](std::size_t tile) {
    BringOn({static_cast<std::uint32_t>(tile), done_[tile], limit, 0}, watcher, films);
  });
}

std::vector<TileRange> Tasks::Chunks(std::uint64_t limit) const {
  std::vector<TileRange> chunks;
  for (const TileRange& all : Behind(limit)) {
    for (std::uint64_t at = all.begin; at < all.end; at += per_task_) {
      chunks.push_back({all.tile, at, std::min(all.end, at + per_task_), 0});
    }
  }
  return chunks;
}

void Tasks::RunRoundInChunks(std::uint64_t limit, TaskWatcher& watcher, Films& films) {
  const std::vector<TileRange> chunks = Chunks(limit);
  if (buffers_.size() < chunks.size()) buffers_.resize(chunks.size());
  ParallelFor(chunks.size(), [&](std::size_t i) {
    buffers_[i].count = 0;
    if (watcher.Stopped()) return;
    if (RunTask(chunks[i], watcher, buffers_[i])) watcher.TaskDone();
  });
  MergeChunks(chunks, films);
}

void Tasks::MergeChunks(const std::vector<TileRange>& chunks, Films& films) {
  std::vector<std::size_t> first(done_.size(), chunks.size());  // of each tile
  for (std::size_t i = chunks.size(); i-- > 0;) first[chunks[i].tile] = i;
  ParallelFor(done_.size(), [&](std::size_t tile) {
    // Stops at the first range that did not run: later ones would leave a gap.
    for (std::size_t i = first[tile]; i < chunks.size() && chunks[i].tile == tile; ++i) {
      if (buffers_[i].count == 0) return;
      Merge(tile, buffers_[i], films);
    }
  });
}

// False, and no samples, if it was put down.
bool Tasks::RunTask(const TileRange& range, const TaskWatcher& watcher,
                    TaskSamples& out) {
  const TileTask task = {range.tile, partition_.tiles[range.tile],
                         static_cast<std::uint32_t>(range.begin - first_),
                         static_cast<std::uint32_t>(range.end - range.begin)};
  if (!runner_.Run(task, watcher, out)) return false;
  taken_ += out.counts.samples;
  return true;
}

void Tasks::Merge(std::size_t tile, TaskSamples& task, Films& films) {
  runner_.Merge(PlaceInFilm(options_, partition_.tiles, tile), task, films);
  done_[tile] += task.count;
  const std::lock_guard lock(counts_mutex_);
  counts_.Add(task.counts);
}

void Tasks::AddCounts(RunResult& result) {
  result.samples = counts_.samples;
  result.rays_closest = counts_.rays_closest;
  result.rays_shadow = counts_.rays_shadow;
  result.health = counts_.health;
  runner_.AddCounts(result);
  for (const TaskSamples& buffer : buffers_) {
    result.wavefront_bytes += buffer.values.size() * sizeof(float);
  }
}

}  // namespace lanelight
