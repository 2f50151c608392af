// The render of a cell. The only file of the sweep that runs jobs.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "src/measure/sweep/sweep_file.h"
#include "src/render/job/render.h"
#include "src/render/job/saving.h"

namespace lanelight {

/// Renders cells one after the other, and compiles a scene again only where two in a row
/// differ in more than strategy, amount and seed. Its trees are built again only where
/// the shapes are others.
class CellRenderer {
 public:
  /// `sweep` must outlive the object. No scene may read of `outputs`.
  explicit CellRenderer(const Sweep& sweep, OutputPaths outputs = {})
      : sweep_(sweep), outputs_(std::move(outputs)) {}

  /// The scene as the cell wants it, with its strategy and amount. Throws InputError.
  Job Prepare(const SweepCell& cell);

  /// Renders into image.exr (and image.png) of `folder`, an existing directory. The
  /// report is in the result only. Throws InputError.
  Rendering Render(const SweepCell& cell, const std::string& folder,
                   const RenderHooks& hooks);

  /// What a compiled scene is of: cells of the same text share it.
  std::string SceneKey(const SweepCell& cell) const;
  /// Returns whether this machine has the cell's SIMD target.
  static bool HasTarget(const SweepCell& cell);

 private:
  void Compile(const SweepCell& cell, RenderSettings settings);

  const Sweep& sweep_;
  OutputPaths outputs_;
  std::optional<Job> job_;     // of the last cell, with the scene's own strategy
  std::string key_, failure_;  // of job_; why there is none
  std::string tree_key_;       // of its trees, as far as cells tell
};

}  // namespace lanelight
