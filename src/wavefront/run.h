// Runs a plan: distributes (tile x sample range) tasks over threads, each with its own
// wavefront, and gathers the film.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "src/image/accumulator.h"
#include "src/wavefront/plan.h"
#include "src/wavefront/tiles.h"

namespace lanelight {

struct Progress {
  double fraction = 0;  // of the planned samples, or of the time budget
  double seconds = 0;   // since the start of rendering
  std::uint64_t samples = 0;
};

struct RunOptions {
  std::uint64_t spp = 0;  // samples per pixel; 0: until `seconds` or stop
  double seconds = 0;     // time budget; 0 = none
  std::uint64_t seed = 0;
  std::function<void(const Progress&)> on_progress;  // about 10 times a second
  const std::atomic<bool>* stop = nullptr;           // finish the samples in flight
  bool profile = true;                               // time every stage call
  /// roulette=efficiency keeps its rule even where the pilot passes prefer another.
  bool keep_roulette = false;
  /// Renders these windows of the image only, all of the same width and height, up to 64.
  /// The film is then a strip in which they lie side by side, in order, from (0, 0) on.
  /// They have the samples that a render of the whole image gives these pixels.
  std::vector<PixelRect> windows;
  /// What pilot passes are sized for; 0: the samples of this run.
  std::uint64_t planned_samples = 0;
};

struct StageProfile {
  std::string name;
  std::uint64_t calls = 0, items = 0, lane_slots = 0;  // lane_slots = vectors * lanes
  double seconds = 0;
  double bytes_per_item = 0;  // columns read + written
  /// items / lane_slots in [0, 1]
  double Occupancy() const { return lane_slots ? double(items) / double(lane_slots) : 0; }
};

/// Bad samples seen by the accumulate stage; each is replaced by zero and counted.
struct Health {
  std::uint64_t nan = 0, infinite = 0, negative = 0;
  std::uint64_t Total() const { return nan + infinite + negative; }
};

struct RunResult {
  double seconds = 0;
  std::uint64_t samples = 0, rays_closest = 0, rays_shadow = 0;
  Health health;
  std::vector<StageProfile> stages;  // in execution order
  bool stopped_early = false;
  std::optional<ControlReport> control;  // of control variates that are fitted
  std::size_t wavefront_bytes = 0;       // all wavefronts and sample buffers together
  // Pilot passes (roulette=adjoint, efficiency); their time is part of `seconds`, their
  // samples and rays are not part of those above.
  double pilot_seconds = 0;
  std::uint64_t pilot_samples = 0, pilot_rays = 0;
  std::string pilot_note;                     // empty: there was none
  Roulette roulette = Roulette::kThroughput;  // that the image was rendered with
};

/// Renders into `film` (its size must match the crop window of the scene, or the strip of
/// options.windows).
RunResult Run(const CompiledScene& scene, const Plan& plan, const RunOptions& options,
              FilmAccumulator& film);

}  // namespace lanelight
