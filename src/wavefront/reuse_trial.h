// Whether paths that serve their block (reuse=block) would pay, from a few samples of
// whole tiles: of decide=pilot, and of `lanelight advise`.
#pragma once

#include <string>
#include <vector>

#include "src/wavefront/decision_candidates.h"
#include "src/wavefront/pilot_comparison.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/training.h"
#include "src/wavefront/training_pass.h"

namespace lanelight {

/// A strategy, and what it has learned.
struct ReuseRival {
  PlanOptions options;
  const StrategyTables* tables = nullptr;
};

struct ReuseVerdict {
  bool pays_per_pixel = false, pays = false;
  /// How many times as efficient it is, by pixels and by squares of 8 x 8 of them: errors
  /// of the pixels of a block have much in common, so that a filter takes less away.
  PilotGain gain;
  double per_pixel = 1, filtered = 1;
  std::uint64_t samples = 0, rays = 0;
};

/// A trial: what it depends on beside the scene.
struct ReuseTrial {
  std::uint32_t seed = 0;
  std::uint64_t samples = 0;     // of each strategy, about
  double must_gain = kMustGain;  // for less than that a choice would not be changed
  const TaskWatcher* watcher = nullptr;
};

/// Renders samples of whole tiles with each, with the same random numbers: paths are the
/// same up to their second vertices, so that a rare bright one is in both. It pays if it
/// is clearly better by pixels (also without any one tile, tiles being independent), and
/// not worse by squares. Depends on scene, options, tables and seed alone: costs are
/// counted in rays, a ray of `reuse` costing kReusePrice times as much.
ReuseVerdict TryReuse(const CompiledScene& scene, const ReuseRival& usual,
                      const ReuseRival& reuse, const ReuseTrial& trial);

/// A choice of blocks, and what a trial says of it.
struct TriedBlocks {
  const char* changes;  // as in --strategy
  ReuseVerdict verdict;
};
/// Blocks of 64 paths, and of 32 if those pay by pixels and not after a filter: smaller
/// ones gain less by pixels, and more after a filter. The last is the one to take, if it
/// pays. None where the scene or `usual` does not take them, or after an interrupt.
std::vector<TriedBlocks> TryBlocks(const CompiledScene& scene, const ReuseRival& usual,
                                   const ReuseTrial& trial);

}  // namespace lanelight
