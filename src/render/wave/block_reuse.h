// reuse=block: the memory of a task's first and second vertices, and the loop over its
// blocks when its paths have ended (src/vocabulary/path/block.h, kernels/reuse/).
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/render/plan/plan.h"
#include "src/render/wave/stage_clock.h"
#include "src/vocabulary/path/block.h"
#include "src/vocabulary/path/stage.h"
#include "src/vocabulary/path/wave.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

/// All that a layout depends on: not the sample range of a task.
struct BlockKey {
  PixelRect tile;
  std::uint32_t seed = 0, sample = 0;
};

/// The pixels of a tile, block by block.
struct BlockOrder {
  std::vector<std::uint32_t> places;  // in TilePixels' order of the tile
  std::vector<std::uint32_t> ends;    // of blocks, in `places`
  std::vector<float> numbers;         // uniform, one for each block
  std::vector<std::uint64_t> keys;    // room
};

/// Divides the tile into blocks of at most `paths` pixels: another layout for each
/// sample, since fixed blocks would show as a mosaic.
void LayOutBlocks(const BlockKey& key, BlockLayout layout, std::uint32_t paths,
                  BlockOrder& order);

class BlockReuse {
 public:
  /// Requires a plan with kReuse. `strategy` says how many paths are connected, and
  /// which.
  BlockReuse(const Plan& plan, const Strategy& strategy);

  /// Makes room for the paths of a task, before they begin, and lets `paths` record them.
  void Begin(const TileWork& work, Wave& paths);
  /// Connects the paths when they have ended. Adds rays and health to `paths`.
  void Connect(const PixelRect& tile, Wave& paths, StageClock* clock);

 private:
  void MakeRoom(std::uint32_t samples, const PathColumns& paths);
  void PlacePairs();
  float CertainlyKept(std::uint32_t sample);
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
