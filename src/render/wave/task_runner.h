// One task: samples of the pixels of a tile, in the wavefront of the thread that runs it:
// waves of stages until all of them are done.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "src/render/wave/films.h"
#include "src/render/wave/run_options.h"
#include "src/render/wave/run_result.h"
#include "src/render/wave/sample_range.h"
#include "src/render/wave/seen_lights.h"
#include "src/render/wave/task_watcher.h"
#include "src/render/wave/workspace.h"

namespace lanelight {

/// Samples of a pixel in adjacent slots of a plan's wavefront: their rays share more of
/// the scene than those of neighbouring pixels. Never more than it has slots; even where
/// samples come in pairs.
std::uint32_t SamplesTogether(const PreparedScene& scene, const Plan& plan);

class TaskRunner {
 public:
  /// Refers to all of these for as long as it lives; plan and parameters may change until
  /// the first task.
  TaskRunner(const PreparedScene& scene, const Plan& plan, const RunParameters& run,
             const RunOptions& options);

  /// Tasks are of so many tiles from here on.
  void Begin(std::size_t tiles);
  /// Where the camera sees edges of lights; null: they are not integrated apart.
  const SeenLightEdges* seen_lights() const { return seen_lights_.get(); }

  // Safe from different threads:
  /// Looks for edges of lights in a tile, if nobody has, and they are integrated apart.
  void FindSeenLights(std::size_t tile, const PixelRect& rect);
  /// Renders a range of samples of a tile, whose pixels are `rect` of the full image.
  /// Returns false, and no samples, if the watcher has cancelled it.
  bool Run(const SampleRange& range, const PixelRect& rect, const TaskWatcher& watcher,
           TaskSamples& out);
  /// Adds samples to the films, whose pixels lie at `place`, and counts their time.
  void Merge(const PixelRect& place, TaskSamples& samples, Films& films);
  /// Room for samples, of this thread.
  TaskSamples& Samples() { return ThreadWorkspace().samples; }

  /// What all threads have counted, and their memory. Takes the trace along.
  void AddCounts(RunResult& result);

 private:
  Workspace& ThreadWorkspace();
  TileWork SetUp(const SampleRange& range, const PixelRect& rect, Workspace& space) const;
  SampleBuffer Buffer(const TileWork& work, TaskSamples& out) const;
  void SeeLights(const SampleRange& range, const PixelRect& rect, TaskSamples& out,
                 Workspace& space) const;

  const PreparedScene& scene_;
  const Plan& plan_;
  const RunParameters& run_;
  const RunOptions& options_;
  std::unique_ptr<SeenLightEdges> seen_lights_;  // null: not apart
  std::vector<std::unique_ptr<Workspace>> workspaces_;
};

}  // namespace lanelight
