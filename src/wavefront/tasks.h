// The work of a run: (tile x sample range) tasks over threads (task_runner.h), merged
// into the films in their order.
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "src/wavefront/crew.h"
#include "src/wavefront/films.h"
#include "src/wavefront/hand_out.h"
#include "src/wavefront/run.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/task_runner.h"
#include "src/wavefront/task_watcher.h"
#include "src/wavefront/tiles.h"

namespace lanelight {

class Tasks {
 public:
  /// Refers to all of these for as long as it lives; plan and parameters may change until
  /// the first round, the parameters' seed between rounds.
  Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
        const RunOptions& options, std::uint64_t planned_spp);

  std::uint64_t pixels() const { return pixel_count_; }
  std::size_t tiles() const { return partition_.tiles.size(); }
  /// Samples of all pixels together, of tasks that may not be merged yet.
  std::uint64_t taken() const { return taken_; }
  /// What has been merged into the films; without seconds.
  const RunCounts& counts() const { return counts_; }
  /// Begins with films that have samples, and what had been counted for them.
  void GoOn(const Films& films, const RunCounts& counts);
  /// Samples per pixel that all tiles have.
  std::uint64_t Done() const;
  /// All tiles have just so many.
  bool IsAt(std::uint64_t limit) const;
  /// The round that keeps all threads busy.
  Round FullRound() const;

  /// Does the work. Tiles may be left behind where the watcher has stopped it; a task
  /// that was put down is as if it had not begun.
  void RunRound(const RoundWork& work, TaskWatcher& watcher, Films& films);

  // The same tile by tile, for who shares the work with others.
  /// Of the full image.
  const std::vector<PixelRect>& rects() const { return partition_.tiles; }
  /// Begins a round: its first sample and samples per task.
  void BeginRound(const RoundWork& work);
  /// What tiles lack to `limit` samples per pixel.
  std::vector<TileRange> Behind(std::uint64_t limit) const;
  std::uint64_t Done(std::size_t tile) const { return done_[tile]; }
  /// Brings a tile to `range.end` samples per pixel, in its order, or less far where the
  /// watcher has stopped it; returns what that came to, without seconds. Safe for
  /// different tiles from different threads.
  RunCounts BringOn(const TileRange& range, TaskWatcher& watcher, Films& films);
  /// The films have been given so many samples of the pixels of a tile.
  void Put(std::size_t tile, std::uint64_t done) { done_[tile] = done; }
  /// Counts what others have rendered.
  void Credit(const RunCounts& counts);

  /// Takes the trace along. After the last round; the result has its rows and its scale.
  void AddCounts(RunResult& result);

 private:
  std::vector<TileRange> Chunks(std::uint64_t limit) const;
  void RunRoundInChunks(std::uint64_t limit, TaskWatcher& watcher, Films& films);
  void MergeChunks(const std::vector<TileRange>& chunks, Films& films);
  bool RunTask(const TileRange& range, const TaskWatcher& watcher, TaskSamples& out);
  void Merge(std::size_t tile, TaskSamples& task, Films& films);

  const RunOptions& options_;
  TilePartition partition_;
  std::uint64_t pixel_count_ = 0;
  std::uint64_t first_ = 0;          // of the current round
  std::uint32_t per_task_ = 1;       // of the current round
  std::vector<std::uint64_t> done_;  // samples per pixel of each tile
  TaskRunner runner_;
  bool begun_ = false;  // the runner knows the tiles
  std::vector<TaskSamples> buffers_;
  std::atomic<std::uint64_t> taken_{0};
  RunCounts counts_;
  std::mutex counts_mutex_;
};

}  // namespace lanelight
