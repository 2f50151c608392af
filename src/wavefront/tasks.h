// The work of a run: (tile x sample range) tasks over threads, and the film that gathers
// them.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "src/image/regression_film.h"
#include "src/wavefront/run.h"
#include "src/wavefront/schedule.h"
#include "src/wavefront/tiles.h"
#include "src/wavefront/workspace.h"

namespace lanelight {

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
        const RunOptions& options, std::uint64_t planned_spp, FilmAccumulator& film);

  /// Control variates whose coefficients come from the samples take further planes.
  /// Before the first round.
  void UseControl();
  /// Size of the groups of a fitted control variate; the film has its own.
  void Regroup(std::uint32_t group_size);

  std::uint64_t pixels() const { return pixel_count_; }
  std::size_t tiles() const { return partition_.tiles.size(); }
  /// Taken so far, of all pixels together.
  std::uint64_t samples() const { return samples_; }
  /// The round that keeps all threads busy.
  Round FullRound() const;

  /// The samples [first_sample, limit) of every pixel, in tasks of `per_task` of them.
  void RunRound(std::uint64_t first_sample, std::uint64_t limit, std::uint32_t per_task,
                TaskWatcher& watcher);

  std::optional<ControlReport> Control() const;
  /// Takes the trace along. After the last round; the result has its rows and its scale.
  void AddCounts(RunResult& result);

 private:
  static constexpr int kMostPlanes =
      kColorPlanes + kAovPlanes + kColorPlanes + RegressionFilm::kPlanes;

  void UseTiles(const PixelRect& pixels, std::uint64_t planned_spp);
  PixelRect Place(std::size_t tile) const;
  void RunRoundInChunks(std::uint64_t first_sample, std::uint64_t limit,
                        std::uint32_t chunks, TaskWatcher& watcher);
  Workspace& ThreadWorkspace();
  void RunTask(const PixelRect& tile, std::uint64_t first_sample, std::uint64_t limit,
               TaskSamples& out);
  void Merge(const PixelRect& tile, TaskSamples& task);

  const CompiledScene& scene_;
  const Plan& plan_;
  const RunParameters& run_;
  const RunOptions& options_;
  FilmAccumulator& film_;
  TilePartition partition_;
  std::uint64_t pixel_count_ = 0;
  int planes_ = kColorPlanes;
  int difference_plane_ = 0;  // of c=optimal, if there are such planes
  std::optional<RegressionFilm> regression_;
  int numbers_plane_ = 0;
  std::uint32_t per_task_ = 1;  // of the current round
  std::vector<std::unique_ptr<Workspace>> workspaces_;
  std::vector<TaskSamples> buffers_;
  std::atomic<std::uint64_t> samples_{0};
};

}  // namespace lanelight
