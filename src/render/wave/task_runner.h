// One task: samples of the pixels of a tile, in the wavefront of the thread that runs it:
// waves of stages until all of them are done.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "src/render/plan/plan_features.h"
#include "src/render/wave/block_reuse.h"
#include "src/render/wave/films.h"
#include "src/render/wave/light_paths.h"
#include "src/render/wave/run_options.h"
#include "src/render/wave/run_result.h"
#include "src/render/wave/run_state.h"
#include "src/render/wave/visible_lights.h"
#include "src/render/wave/shared_samples.h"
#include "src/render/wave/stage_clock.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/tiles.h"
#include "src/render/wave/wavefront.h"

namespace lanelight {

/// Memory that a thread keeps between tasks.
struct Workspace {
  Workspace(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
            const RunOptions& options, const PixelRect& window);
  /// Null if nothing is timed.
  StageClock* Clock() { return clock ? &*clock : nullptr; }

  Wavefront wavefront;
  std::optional<BlockReuse> reuse;
  std::optional<LightSubpaths> light_paths;
  std::optional<VisibleLightRays> visible_lights;
  std::optional<SampleSharing> sharing;
  std::optional<StageClock> clock;
  std::vector<std::uint32_t> pixels;
  std::vector<float> filter_places;
  TaskSamples samples;
};

/// Returns how many samples of a pixel are in adjacent slots of the wavefront: their rays
/// share more of the scene than those of neighbouring pixels. Never more than it has
/// slots; even where samples come in pairs.
std::uint32_t SamplesTogether(const PreparedScene& scene, const Plan& plan);

class TaskRunner {
 public:
  /// Refers to all of these for as long as it lives; plan and parameters may change until
  /// the first task. `window`: pixels of the film.
  TaskRunner(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options, const PixelRect& window);

  /// Sets the number of tiles, before the first task.
  void Begin(std::size_t tiles);
  /// Returns the edges of directly visible lights; null if these are not integrated
  /// apart.
  const VisibleLightEdges* visible_lights() const { return visible_lights_.get(); }

  // Safe from different threads:
  /// Finds the edges of directly visible lights in a tile, once.
  void FindVisibleLights(std::size_t tile, const PixelRect& rect);
  /// Renders a range of samples of a tile, whose pixels are `rect` of the full image.
  /// Returns false, and no samples, if the watcher has cancelled it.
  bool Run(const SampleRange& range, const PixelRect& rect, const TaskWatcher& watcher,
           TaskSamples& out);
  /// Adds samples to the films, whose pixels lie at `place`, and counts their time.
  void Merge(const PixelRect& place, TaskSamples& samples, Films& films);
  /// Returns the sample memory of this thread.
  TaskSamples& Samples() { return ThreadWorkspace().samples; }

  /// Adds the counts and memory of all threads to the result, and moves the trace there.
  void AddCounts(RunResult& result);

 private:
  Workspace& ThreadWorkspace();
  TileWork SetUp(const SampleRange& range, const PixelRect& rect, Workspace& space) const;
  SampleBuffer Buffer(const TileWork& work, TaskSamples& out) const;
  void ShareSamples(const SampleRange& range, const PixelRect& rect, TaskSamples& out,
                    Workspace& space) const;

  const PreparedScene& scene_;
  const Plan& plan_;
  const RunParameters& run_;
  const RunOptions& options_;
  const PixelRect window_;
  std::unique_ptr<VisibleLightEdges> visible_lights_;  // null: not apart
  std::vector<std::unique_ptr<Workspace>> workspaces_;
};

}  // namespace lanelight
