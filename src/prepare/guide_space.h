// The tree over position and normal of a guide, from where records are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/prepare/guide_records.h"

namespace lanelight {

/// A node of the tree and the records in it. Children are neighbours, and come after
/// their parent.
struct GuideSpaceNode {
  std::size_t begin = 0, end = 0;  // records
  int depth = 0;
  int axis = -1;  // Guide::Node's; -1: a leaf
  float at = 0;   // records below it are in the first child
  std::uint32_t first_child = 0;

  std::size_t count() const { return end - begin; }
};

/// Divides nodes with more than `most` records, the upper levels first, down to
/// kGuideDepth levels and up to `most_cells` leaves. Sorts the records so that those of a
/// node lie together. Depends on the records and their order alone.
///
/// A node that sees surfaces of different orientations is divided by the normal first: a
/// density for several walls is right for none. Else it is halved by the median along
/// the axis where the middle nine tenths of the records spread furthest, whatever lies
/// far outside.
std::vector<GuideSpaceNode> DivideGuideSpace(std::vector<GuideRecord>& records,
                                             std::size_t most, std::size_t most_cells);

}  // namespace lanelight
