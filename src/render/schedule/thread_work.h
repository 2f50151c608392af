// Renders rounds on the threads of this process: takes ranges of samples from the
// scheduler, runs them (src/render/wave/task_runner.h), and merges them into the films.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "src/render/schedule/round_runner.h"
#include "src/render/schedule/scheduler.h"
#include "src/render/wave/films.h"
#include "src/render/wave/task_runner.h"
#include "src/render/wave/tiles.h"

namespace lanelight {

class ThreadWork : public RoundRunner {
 public:
  /// Refers to all of these for as long as it lives; plan and parameters may change until
  /// the first round, the parameters' seed between rounds.
  ThreadWork(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, Films& films);

  void RunRound(const Round& round, TaskWatcher& watcher) override;
  TileLevels Levels() const override { return LevelsOf(scheduler_->Snapshot()); }
  RunCounts Counts() const override { return counts_; }
  std::uint64_t Taken() const override { return taken_; }

  Scheduler& scheduler() { return *scheduler_; }
  /// Samples per pixel of a range that keeps a thread busy.
  std::uint32_t samples_per_range() const { return samples_per_range_; }
  /// Continues with the samples in the films, which have these counts.
  void Resume(const RunCounts& counts);
  /// Before the first round: has these tiles, of which it owns those in `owned`. Other
  /// ranks have the others, and may hand over tiles during a round.
  void ShareTiles(const std::vector<PixelRect>& tiles,
                  const std::vector<TileProgress>& owned);
  /// Adds the profile of all threads to the result and takes the trace along. After the
  /// last round; the result has its rows and its scale.
  void AddProfile(RunResult& result);

 private:
  void UseTiles(TilePartition partition);
  void Merge(std::size_t tile, TaskSamples& task);

  const PreparedScene& scene_;
  const RunOptions& options_;
  Films& films_;
  std::unique_ptr<Scheduler> scheduler_;
  std::uint32_t samples_per_range_ = 1;
  TaskRunner runner_;
  bool begun_ = false;   // the runner knows the tiles
  bool shared_ = false;  // other ranks have tiles
  std::atomic<std::uint64_t> taken_{0};
  RunCounts counts_;
  std::mutex counts_mutex_;
};

}  // namespace lanelight
