// Whether paths that serve their block (reuse=block) would pay, from a few samples of
// whole tiles: of decide=pilot.
#pragma once

#include <string>

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
  double per_pixel = 1, filtered = 1;
  std::uint64_t samples = 0, rays = 0;
};

/// Renders about `samples` samples of whole tiles with each, with the same random
/// numbers: paths are the same up to their second vertices, so that a rare bright one is
/// in both. It pays if it is clearly better by pixels (also without any one tile, tiles
/// being independent), and not worse by squares. Depends on scene, options, tables and
/// seed alone: costs are counted in rays, a ray of `reuse` costing kReusePrice times as
/// much.
ReuseVerdict TryReuse(const CompiledScene& scene, const ReuseRival& usual,
                      const ReuseRival& reuse, std::uint32_t seed, std::uint64_t samples,
                      const TaskWatcher* watcher);

}  // namespace lanelight
