// Splits of a range of items: by their centres (binned SAH), or by a plane that cuts
// triangles (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume
// Hierarchies").
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

struct TriangleRecord;  // src/scene/geometry/geometry.h

/// A plane across `axis` at `x`, and the two sides of it: boxes and numbers of the parts
/// of triangles there.
struct SpatialSplit {
  int axis = -1;  // -1: none
  float x = 0;
  float cost = INFINITY;  // sum of half area times blocks, as of an ObjectSplit
  WideBox box[2];
  std::uint32_t count[2] = {0, 0};
};

/// Items in [begin, end) of an array, with room for more up to `limit`.
struct ItemRange {
  std::uint32_t begin = 0, end = 0, limit = 0;

  std::uint32_t count() const { return end - begin; }
  std::uint32_t room() const { return limit - end; }
};

/// The best of some planes for the items in `range`, whose union is `box`, that makes no
/// more items than there is room for. An item is what lies in its box of triangle `id`.
SpatialSplit FindSpatialSplit(const BuildItem* items, ItemRange range,
                              const AccelBox& box, const TriangleRecord* triangles,
                              std::uint32_t leaf_size);

/// Sorts the items to the sides of `split`, those of the second behind those of the
/// first, and returns where the second side begins. Cuts items that lie on both sides,
/// or leaves them whole on one side, where that costs less or there is no room; parts are
/// appended to `range`. No side has an item twice. One side may be empty: then no item
/// has changed.
std::uint32_t CutAndPartition(BuildItem* items, ItemRange& range,
                              const SpatialSplit& split, const TriangleRecord* triangles);

}  // namespace lanelight
