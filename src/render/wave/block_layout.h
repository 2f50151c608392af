// Which pixels of a tile make a block of reuse=block: another set for each sample, else
// the same neighbours would share their errors in every sample, and a mosaic is seen.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/image/pixel_rect.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

/// What a layout depends on, and nothing else: not on the sample range of a task.
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

/// Blocks of at most `paths` pixels, each pixel of the tile in one.
void LayOutBlocks(const BlockKey& key, BlockLayout layout, std::uint32_t paths,
                  BlockOrder& order);

}  // namespace lanelight
