// Splits of a range of items by their centres: binned SAH.
#pragma once

#include <cstdint>

#include "src/scene/accel/wide_box.h"

namespace lanelight {

struct ObjectSplit {
  int axis = -1;  // -1: none, all centres are equal
  int bin = 0;    // items of bins < bin go left
  float cost = INFINITY;
  /// Half area of what the boxes of both sides have in common, if it was asked for.
  float overlap = INFINITY;
};

/// Number of full leaves that `count` items fill.
inline float Blocks(std::uint32_t count, std::uint32_t leaf_size) {
  return static_cast<float>((count + leaf_size - 1) / leaf_size);
}

/// Parameters of the search: splits into leaves of `leaf_size` items along all axes, or
/// only along the one on which centres are farthest apart; and ObjectSplit::overlap.
struct SplitSearch {
  std::uint32_t leaf_size = 1;
  bool overlap = false, one_axis = false;
};

/// The split of `count` items with the least sum of half area times blocks. `centers`
/// holds twice their centres.
ObjectSplit FindObjectSplit(const BuildItem* items, std::uint32_t count,
                            const AccelBox& centers, const SplitSearch& search);

/// Sorts the items to the sides of `split`; returns how many lie on the first.
std::uint32_t Partition(BuildItem* items, std::uint32_t count, const AccelBox& centers,
                        const ObjectSplit& split);

}  // namespace lanelight
