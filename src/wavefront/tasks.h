// The work of a run: (tile x sample range) tasks over threads, each with a wavefront of
// its own, merged into the films in their order.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "src/wavefront/films.h"
#include "src/wavefront/run.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/tiles.h"
#include "src/wavefront/workspace.h"

namespace lanelight {

/// The loop of one task: runs `work` to the end on `wavefront`, writing finished samples
/// to `buffer`. `clock` times the stages; null: nothing is timed.
void Drive(Wavefront& wavefront, const Plan& plan, const TileWork& work,
           const SampleBuffer& buffer, StageClock* clock);

/// Who asks for the work. Both may be called from any thread.
class TaskWatcher {
 public:
  virtual ~TaskWatcher() = default;
  /// True: tasks that have not begun are left out.
  virtual bool Stopped() const = 0;
  virtual void TaskDone() = 0;
};

class Tasks {
 public:
  /// Refers to all of these for as long as it lives; plan and parameters may change until
  /// the first round, the parameters' seed and groups between rounds.
  Tasks(const CompiledScene& scene, const Plan& plan, const RunParameters& run,
        const RunOptions& options, std::uint64_t planned_spp);

  std::uint64_t pixels() const { return pixel_count_; }
  std::size_t tiles() const { return partition_.tiles.size(); }
  /// Taken so far, of all pixels together.
  std::uint64_t samples() const { return samples_; }
  /// The round that keeps all threads busy.
  Round FullRound() const;

  /// The samples [first_sample, limit) of every pixel, in tasks of `per_task` of them.
  void RunRound(std::uint64_t first_sample, std::uint64_t limit, std::uint32_t per_task,
                TaskWatcher& watcher, Films& films);

  /// Takes the trace along. After the last round; the result has its rows and its scale.
  void AddCounts(RunResult& result);

 private:
  void UseTiles(const PixelRect& pixels, std::uint64_t planned_spp);
  PixelRect Place(std::size_t tile) const;
  void RunRoundInChunks(std::uint64_t first_sample, std::uint64_t limit,
                        std::uint32_t chunks, TaskWatcher& watcher, Films& films);
  Workspace& ThreadWorkspace();
  void RunTask(const PixelRect& tile, std::uint64_t first_sample, std::uint64_t limit,
               TaskSamples& out);
  void Merge(std::size_t tile, TaskSamples& task, Films& films);

  const CompiledScene& scene_;
  const Plan& plan_;
  const RunParameters& run_;
  const RunOptions& options_;
  TilePartition partition_;
  std::uint64_t pixel_count_ = 0;
  std::uint32_t per_task_ = 1;  // of the current round
  std::vector<std::unique_ptr<Workspace>> workspaces_;
  std::vector<TaskSamples> buffers_;
  std::atomic<std::uint64_t> samples_{0};
};

}  // namespace lanelight
