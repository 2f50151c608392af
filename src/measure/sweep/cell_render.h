// Renders cells, and short probes of them.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "src/measure/sweep/sweep_file.h"
#include "src/render/job/job.h"
#include "src/render/job/render.h"
#include "src/render/job/saving.h"

namespace lanelight {

/// Renders cells one after the other. Compiles a scene again only if two consecutive
/// cells differ in more than strategy, amount and seed; builds BVHs again only for other
/// shapes.
class CellRenderer {
 public:
  /// `sweep` must outlive the object. Scenes must not read `outputs`.
  explicit CellRenderer(const Sweep& sweep, OutputPaths outputs = {})
      : sweep_(sweep), outputs_(std::move(outputs)) {}

  /// Returns the job of a cell. Throws InputError.
  Job Prepare(const SweepCell& cell);

  /// Renders into image.exr (and image.png) of an existing directory. Returns the report.
  /// Throws InputError.
  Rendering Render(const SweepCell& cell, const std::string& folder,
                   const RenderHooks& hooks);

  /// Returns a text that is equal for cells that share a compiled scene.
  std::string SceneKey(const SweepCell& cell) const;
  /// Returns whether this machine has the cell's SIMD target.
  static bool HasTarget(const SweepCell& cell);

 private:
  void Compile(const SweepCell& cell, RenderSettings settings);

  const Sweep& sweep_;
  OutputPaths outputs_;
  std::optional<Job> job_;     // of the last cell, with the scene's strategy
  std::string key_, failure_;  // key of job_; why there is no job
  std::string bvh_key_;        // key of its BVHs
};

/// Speed and error of a short render, for predictions of long ones.
struct ProbeRender {
  double pixels = 0;      // of the image
  std::uint64_t spp = 0;  // the scene's own
  double load_seconds = 0, build_seconds = 0;
  double sample_seconds = 0;   // wall clock of one sample
  double bytes_per_pixel = 0;  // of the image file
  /// Squared errors times samples per pixel; NaN if unknown.
  double relmse = std::numeric_limits<double>::quiet_NaN();
  double mse = std::numeric_limits<double>::quiet_NaN();
};

/// Renders tiles spread over the image for about `seconds`, with at least four samples
/// per pixel. `half`: the file has 16 bits per colour.
ProbeRender RenderProbe(const Job& job, double seconds, bool half);

}  // namespace lanelight
