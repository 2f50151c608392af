// Renders rounds on the threads of this process: takes ranges of samples from the
// scheduler, runs them (src/render/wave/task_runner.h), and merges them into the films.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "src/base/core/stopwatch.h"
#include "src/render/schedule/scheduler.h"
#include "src/render/wave/films.h"
#include "src/render/wave/run_state.h"
#include "src/render/wave/task_runner.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/tiles.h"

namespace lanelight {

/// The time that a run has taken, in this process and before it was resumed.
class RunClock {
 public:
  void Start() { watch_ = {}; }
  /// Adds the seconds that a resumed run took before.
  void StartAt(double seconds) { before_ = seconds; }

  /// Seconds since Start().
  double Seconds() const { return watch_.Seconds(); }
  /// Processor seconds of all threads of this process since Start().
  double CpuSeconds() const { return watch_.CpuSeconds(); }
  /// Seconds of the whole run.
  double Elapsed() const { return before_ + Seconds(); }

 private:
  Stopwatch watch_;
  double before_ = 0;
};

class RoundRunner {
 public:
  virtual ~RoundRunner() = default;

  /// Renders all tiles to the end of the round, unless the watcher stops it. Cancelled
  /// ranges leave no trace. Rethrows exceptions of tasks.
  virtual void RunRound(const Round& round, TaskWatcher& watcher) = 0;
  /// Gathers all samples in the films and in Counts().
  virtual void Gather() {}
  /// Returns the levels of all tiles, after a round.
  virtual TileLevels Levels() const = 0;
  /// Returns the counts of the samples in the films; excludes seconds of this process.
  virtual RunCounts Counts() const = 0;
  /// Returns the samples of all pixels together, merged or not. Safe from any thread.
  virtual std::uint64_t RenderedSamples() const = 0;
  /// Returns whether another process was interrupted or has failed; no more rounds begin
  /// then.
  virtual bool IsStopped() const { return false; }
  /// Ends the work of other processes. Throws RankFailure if one of them has failed.
  virtual void Finish() {}

  /// Returns the samples per pixel that all tiles have.
  std::uint64_t Done() const { return Levels().minimum; }
  /// Returns whether all tiles have exactly so many samples per pixel.
  bool IsAt(std::uint64_t samples) const {
    const TileLevels levels = Levels();
    return levels.minimum == samples && levels.maximum == samples;
  }
};

class ThreadWork : public RoundRunner {
 public:
  /// Keeps references to all of these; plan and parameters may change until the first
  /// round, the parameters' seed between rounds.
  ThreadWork(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, Films& films);

  void RunRound(const Round& round, TaskWatcher& watcher) override;
  TileLevels Levels() const override { return LevelsOf(scheduler_->Snapshot()); }
  RunCounts Counts() const override { return counts_; }
  std::uint64_t RenderedSamples() const override { return rendered_samples_; }

  Scheduler& scheduler() { return *scheduler_; }
  /// Returns the samples per pixel of a range that keeps a thread busy.
  std::uint32_t samples_per_range() const { return samples_per_range_; }
  /// Resumes from the samples in the films, which have these counts.
  void Resume(const RunCounts& counts);
  /// Sets the tiles, of which this rank owns `owned`, before the first round. Other ranks
  /// own the others, and may hand over tiles during a round.
  void ShareTiles(const std::vector<PixelRect>& tiles,
                  const std::vector<TileProgress>& owned);
  /// Adds the profile of all threads to the result, whose rows and scale are set, and
  /// moves the trace there; after the last round.
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
  std::atomic<std::uint64_t> rendered_samples_{0};
  RunCounts counts_;
  std::mutex counts_mutex_;
};

}  // namespace lanelight
