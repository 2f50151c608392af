// reuse=block: the memory of a task's first and second vertices, and the loop over its
// blocks when its paths have ended (src/vocabulary/path/block.h, kernels/reuse/).
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/render/plan/plan.h"
#include "src/render/wave/block_layout.h"
#include "src/render/wave/stage_clock.h"
#include "src/vocabulary/path/block.h"
#include "src/vocabulary/path/stage.h"
#include "src/vocabulary/path/wave.h"

namespace lanelight {

class BlockReuse {
 public:
  /// Of a plan with kReuse. `strategy` says how many paths are connected, and which.
  BlockReuse(const Plan& plan, const Strategy& strategy);

  /// Before the paths of a task begin: makes room for them, and has `paths` keep them.
  void Begin(const TileWork& work, Wave& paths);
  /// When they have ended: shares their light out. Counts rays and health in `paths`.
  void Connect(const PixelRect& tile, Wave& paths, StageClock* clock);

  std::size_t bytes() const;

 private:
  void MakeRoom(std::uint32_t samples, const PathColumns& paths);
  void PlacePairs();
  float SurelyKept(std::uint32_t sample);
  void ConnectSample(const BlockKey& key, std::uint32_t sample, StageClock* clock);

  const Plan& plan_;
  const std::uint32_t paths_;
  const BlockLayout layout_;
  std::uint32_t room_ = 0;  // samples
  UntouchedVector<std::uint32_t> records_, pairs_;
  Wave first_, glossy_;  // whose slots are records
  Wave wave_;            // whose slots are pairs
  Block block_;
  BlockOrder order_;
  std::vector<std::uint32_t> members_;
  std::vector<float> sent_;
};

}  // namespace lanelight
