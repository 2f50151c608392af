#include "src/run/tasks.h"

#include <algorithm>
#include <utility>

#include "src/core/parallel.h"
#include "src/wave/partition.h"

namespace lanelight {

Tasks::Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, std::uint64_t planned_spp)
    : scene_(scene),
      options_(options),
      planned_spp_(planned_spp),
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

std::vector<std::vector<PixelRect>> Tasks::Deal(const std::vector<int>& threads, int rank,
                                                const Films& films) {
  const int least_side = scene_.strategy.MayReuse() ? kReuseTile : 1;
  auto parts = DealTiles(partition_.tiles, threads, least_side);
  const auto own = static_cast<std::size_t>(rank);
  const auto samples = [&](const PixelRect& tile) {
    return films.film().Samples(tile.x0, tile.y0);
  };
  RunOptions all;
  for (std::size_t r = 0; r < parts.size(); ++r) {
    all.tiles.insert(all.tiles.end(), parts[r].begin(), parts[r].end());
    if (r == own) continue;
    for (const PixelRect& tile : parts[r]) {
      others_.levels.Add({samples(tile), samples(tile)});
    }
  }
  // Tasks are the same on all ranks.
  partition_ = PartitionOf(scene_, all, planned_spp_);
  partition_.tiles = parts[own];
  done_.clear();
  for (const PixelRect& tile : parts[own]) done_.push_back(samples(tile));
  return parts;
}

RunCounts Tasks::counts() const {
  RunCounts all = counts_;
  all.Add(others_.counts);
  return all;
}

TileLevels Tasks::Levels() const {
  TileLevels levels;
  for (const std::uint64_t done : done_) levels.Add({done, done});
  return levels;
}

std::uint64_t Tasks::Done() const {
  return std::min(Levels().least, others_.levels.least);
}

bool Tasks::IsAt(std::uint64_t limit) const {
  TileLevels levels = Levels();
  levels.Add(others_.levels);
  return levels.least == limit && levels.most == limit;
}

void Tasks::AddOthers(const RunCounts& counts, const TileLevels& levels) {
  others_.counts.Add(counts);
  others_.levels.Add(levels);
}

void Tasks::OthersAreAt(std::uint64_t limit) {
  others_.levels = {limit, std::max(limit, others_.levels.most)};
}

bool Tasks::OthersHaveTaken(std::uint64_t samples) {
  return taken_elsewhere_.exchange(samples) != samples;
}

void Tasks::RunRound(const RoundWork& work, TaskWatcher& watcher, Films& films) {
  if (!begun_) runner_.Begin(partition_.tiles);
  begun_ = true;
  first_ = work.first;
  const auto threads = static_cast<std::uint32_t>(MaxThreads());
  const auto tiles = static_cast<std::uint32_t>(done_.size());
  TileQueue queue(done_, {work.limit, work.per_task,
                          std::max(1u, 8 * threads / std::max(1u, tiles))});
  ParallelFor(threads, [&](std::size_t) {
    try {
      while (const auto range = queue.Next(watcher)) {
        TaskSamples& out = runner_.Samples();
        if (!runner_.Run(TaskOf(*range), watcher, out)) return queue.Stop();
        taken_ += out.counts.samples;
        queue.Ended(*range, out,
                    [&](TaskSamples& samples) { Merge(range->tile, samples, films); });
        watcher.TaskDone();
      }
    } catch (...) {
      queue.Stop();
      throw;
    }
  });
}

TileTask Tasks::TaskOf(const TileRange& range) const {
  return {range.tile, partition_.tiles[range.tile],
          static_cast<std::uint32_t>(range.begin - first_),
          static_cast<std::uint32_t>(range.end - range.begin)};
}

void Tasks::Merge(std::size_t tile, TaskSamples& task, Films& films) {
  const PixelRect place = PlaceInFilm(options_, partition_.tiles, tile);
  runner_.Merge(place, task, films);
  if (options_.on_tile) options_.on_tile(films.film(), place);
  const std::lock_guard lock(counts_mutex_);
  counts_.Add(task.counts);
  if (options_.on_task) options_.on_task(partition_.tiles[tile], task.counts);
}

void Tasks::AddCounts(RunResult& result) { runner_.AddCounts(result); }

}  // namespace lanelight
