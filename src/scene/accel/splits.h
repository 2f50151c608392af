// Splits of a range of items: by their centres (binned SAH), or by a plane that cuts
// triangles (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume
// Hierarchies").
#pragma once

#include <cstdint>

#include "src/scene/accel/partition.h"

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

/// Parameters of the search: leaves of `leaf_size` items, all axes or only the one with
/// the largest extent of centres, and whether ObjectSplit::overlap is needed.
struct SplitSearch {
  std::uint32_t leaf_size = 1;
  bool overlap = false, one_axis = false;
};

/// Returns the split with the least sum of half area times blocks. `centers` bounds twice
/// the centres of the items.
ObjectSplit FindObjectSplit(const BuildItem* items, std::uint32_t count,
                            const AccelBox& centers, const SplitSearch& search);

/// Sorts the items to the sides of `split`; returns how many lie on the first.
std::uint32_t Partition(BuildItem* items, std::uint32_t count, const AccelBox& centers,
                        const ObjectSplit& split);

struct TriangleRecord;  // src/scene/geometry/geometry.h

/// A plane across `axis` at `x`, with boxes and numbers of the triangle parts on its
/// sides.
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

/// Returns the best of several planes that make no more items than there is room for. An
/// item is the part of triangle `id` in its box; `box` is the union of all.
SpatialSplit FindSpatialSplit(const BuildItem* items, ItemRange range,
                              const AccelBox& box, const TriangleRecord* triangles,
                              std::uint32_t leaf_size);

/// Sorts the items to the sides of `split` and returns where the second side begins.
/// Items on both sides are cut, or kept whole on one side if that costs less or there is
/// no room; parts are appended to `range`. If one side is empty, no item has changed.
std::uint32_t CutAndPartition(BuildItem* items, ItemRange& range,
                              const SpatialSplit& split, const TriangleRecord* triangles);

}  // namespace lanelight
