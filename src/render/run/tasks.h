// The work of a run: (tile x sample range) tasks over threads (task_runner.h), merged
// into the films in their order (tile_queue.h).
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "src/render/run/held_tiles.h"
#include "src/render/run/run.h"
#include "src/render/run/tile_queue.h"
#include "src/render/wave/films.h"
#include "src/render/wave/task_runner.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/tiles.h"

namespace lanelight {

/// Every tile is to have `limit` samples per pixel, in tasks of `per_task` of them.
/// Indices in kernels begin with sample `first`, which no tile is behind.
struct RoundWork {
  std::uint64_t first = 0, limit = 0;
  std::uint32_t per_task = 1;
};

/// Samples per pixel that tiles have: the least, and the most.
struct TileLevels {
  std::uint64_t least = kMostSamplesPerPixel, most = 0;
  void Add(const TileLevels& others) {
    least = std::min(least, others.least);
    most = std::max(most, others.most);
  }
};

class Tasks {
 public:
  /// Refers to all of these for as long as it lives; plan and parameters may change until
  /// the first round, the parameters' seed between rounds.
  Tasks(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
        const RunOptions& options, std::uint64_t planned_spp);

  /// Of all ranks, if the run has several.
  std::uint64_t pixels() const { return pixel_count_; }
  /// Of all ranks, of the full image.
  const std::vector<PixelRect>& tiles() const { return partition_.tiles; }
  /// Those that this rank has.
  std::vector<HeldTile> Held() const;
  /// Samples per pixel that keep a thread busy.
  std::uint32_t per_task() const { return partition_.samples; }
  /// Samples of all pixels together, of tasks that may not be merged yet; of all ranks,
  /// and of this one.
  std::uint64_t taken() const { return taken_ + taken_elsewhere_; }
  std::uint64_t own_taken() const { return taken_; }
  /// What has been merged into the films, and gathered of other ranks; without seconds.
  RunCounts counts() const;
  /// Begins with films that have samples, and what had been counted for them.
  void GoOn(const Films& films, const RunCounts& counts);
  /// Samples per pixel that all tiles of all ranks have.
  std::uint64_t Done() const;
  /// All tiles of all ranks have just so many.
  bool IsAt(std::uint64_t limit) const;
  /// Of this rank.
  TileLevels Levels() const;

  /// Brings this rank's tiles to the limit, also those that come meanwhile. Tiles may be
  /// left behind where the watcher has stopped it; a task that was cancelled is as if it
  /// had not begun.
  void RunRound(const RoundWork& work, TaskWatcher& watcher, Films& films);

  // Of several ranks, each renders a part of the tiles:
  /// Deals the tiles out to ranks of so many threads; this one, `rank`, keeps its part.
  /// The films have what they begin with.
  void Deal(const std::vector<int>& threads, int rank, const Films& films);
  /// Of tiles that no thread is at, gives those away that lack so many samples at most;
  /// safe while RunRound is at work.
  std::vector<HeldTile> Give(std::uint64_t samples);
  /// Has these too, whose pixels are in the films, likewise.
  void Take(const std::vector<HeldTile>& tiles);
  /// Samples that tiles lack to come to the limit.
  std::uint64_t Missing(const std::vector<HeldTile>& tiles, std::uint64_t limit) const;
  /// The others have counted this and have these tiles: of one rank after the other,
  /// after ForgetOthers.
  void AddOthers(const RunCounts& counts, const std::vector<HeldTile>& tiles);
  void ForgetOthers() { others_ = {}; }
  /// All others have brought their tiles to the limit.
  void OthersAreAt(std::uint64_t limit);
  /// The others have taken so many samples; whether these are more than before.
  bool OthersHaveTaken(std::uint64_t samples);

  /// Takes the trace along. After the last round; the result has its rows and its scale.
  void AddCounts(RunResult& result);

 private:
  class OpenQueue;

  TileTask TaskOf(const TileRange& range) const;
  void Merge(std::size_t tile, TaskSamples& task, Films& films);

  struct Others {
    RunCounts counts;
    TileLevels levels;
  };

  const PreparedScene& scene_;
  const RunOptions& options_;
  const std::uint64_t planned_spp_;
  TilePartition partition_;
  std::uint64_t pixel_count_ = 0;
  std::uint64_t first_ = 0;          // of the current round
  std::vector<std::uint64_t> done_;  // samples per pixel of each tile; or kNotHeld
  TileQueue* queue_ = nullptr;       // of the round that is at work
  std::mutex queue_mutex_;           // of these two, but within the queue
  TaskRunner runner_;
  bool begun_ = false;    // the runner knows the tiles
  bool several_ = false;  // ranks
  std::atomic<std::uint64_t> taken_{0}, taken_elsewhere_{0};
  RunCounts counts_;  // of this rank
  Others others_;     // by what has been gathered, or is known
  std::mutex counts_mutex_;
};

}  // namespace lanelight
