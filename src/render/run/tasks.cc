#include "src/render/run/tasks.h"

#include <algorithm>
#include <utility>

#include "src/base/core/parallel.h"
#include "src/render/wave/partition.h"

namespace lanelight {

Tasks::Tasks(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
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

void Tasks::Deal(const std::vector<int>& threads, int rank, const Films& films) {
  const int least_side = scene_.strategy.MayReuse() ? kReuseTile : 1;
  const auto parts = DealTiles(partition_.tiles, threads, least_side);
  RunOptions all;
  done_.clear();
  for (std::size_t r = 0; r < parts.size(); ++r) {
    for (const PixelRect& tile : parts[r]) {
      const std::uint64_t done = films.film().Samples(tile.x0, tile.y0);
      const bool own = r == static_cast<std::size_t>(rank);
      if (!own) others_.levels.Add({done, done});
      all.tiles.push_back(tile);
      done_.push_back(own ? done : kNotHeld);
    }
  }
  // Tasks are the same on all ranks.
  partition_ = PartitionOf(scene_, all, planned_spp_);
  partition_.tiles = all.tiles;
  several_ = true;
}

std::vector<HeldTile> Tasks::Held() const {
  std::vector<HeldTile> held;
  for (std::size_t tile = 0; tile < done_.size(); ++tile) {
    if (done_[tile] != kNotHeld) held.push_back({tile, done_[tile]});
  }
  return held;
}

// Others can reach a queue for as long as this lives.
class Tasks::OpenQueue {
 public:
  OpenQueue(Tasks& tasks, TileQueue& queue) : tasks_(tasks) { Set(&queue); }
  ~OpenQueue() { Set(nullptr); }
  OpenQueue(const OpenQueue&) = delete;
  OpenQueue& operator=(const OpenQueue&) = delete;

 private:
  void Set(TileQueue* queue) {
    const std::lock_guard lock(tasks_.queue_mutex_);
    tasks_.queue_ = queue;
  }

  Tasks& tasks_;
};

std::vector<HeldTile> Tasks::Give(std::uint64_t samples) {
  const std::lock_guard lock(queue_mutex_);
  if (queue_ == nullptr) return {};
  return queue_->Give(samples, partition_.tiles);
}

void Tasks::Take(const std::vector<HeldTile>& tiles) {
  const std::lock_guard lock(queue_mutex_);
  for (const HeldTile& tile : tiles) {
    if (queue_ != nullptr) {
      queue_->Take(tile);
    } else {
      done_[tile.tile] = tile.done;
    }
  }
}

std::uint64_t Tasks::Missing(const std::vector<HeldTile>& tiles,
                             std::uint64_t limit) const {
  std::uint64_t samples = 0;
  for (const HeldTile& tile : tiles) {
    samples +=
        (limit - std::min(limit, tile.done)) * partition_.tiles[tile.tile].pixels();
  }
  return samples;
}

RunCounts Tasks::counts() const {
  RunCounts all = counts_;
  all.Add(others_.counts);
  return all;
}

TileLevels Tasks::Levels() const {
  TileLevels levels;
  for (const HeldTile& tile : Held()) levels.Add({tile.done, tile.done});
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

void Tasks::AddOthers(const RunCounts& counts, const std::vector<HeldTile>& tiles) {
  others_.counts.Add(counts);
  for (const HeldTile& tile : tiles) others_.levels.Add({tile.done, tile.done});
}

void Tasks::OthersAreAt(std::uint64_t limit) {
  others_.levels = {limit, std::max(limit, others_.levels.most)};
}

bool Tasks::OthersHaveTaken(std::uint64_t samples) {
  return taken_elsewhere_.exchange(samples) != samples;
}

void Tasks::RunRound(const RoundWork& work, TaskWatcher& watcher, Films& films) {
  if (!begun_) runner_.Begin(partition_.tiles.size());
  begun_ = true;
  first_ = work.first;
  const auto threads = static_cast<std::uint32_t>(MaxThreads());
  const auto tiles = static_cast<std::uint32_t>(Held().size());
  TileQueue queue(done_, {work.limit, work.per_task,
                          std::max(1u, 8 * threads / std::max(1u, tiles)), several_});
  const OpenQueue open(*this, queue);
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
