// The leaves of triangles: how many triangles fit into one, and filling them.
#pragma once

#include <cstdint>

#include "src/scene/accel/builder.h"
#include "src/scene/geometry/accel.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// Returns the limits of leaves: as many triangles as fit into a shared leaf of up to
/// `leaf_triangles`, or a SeparateLeaf if these typically are at most half as many. The
/// capacity SeparateLeaf::kLanes identifies the latter.
LeafLimit TriangleLimit(const AlignedVector<TriangleRecord>& records, int leaf_triangles);

/// Appends the leaves of a tree to `blocks`: first Place for each of them, then
/// MakeRoom, then Fill by any thread.
class TriangleBlocks {
 public:
  TriangleBlocks(AlignedVector<TriangleBlock>& blocks,
                 const AlignedVector<TriangleRecord>& records, int leaf_triangles);

  /// The reference, less kLeafBit, of the next leaf, as LeafRange::capacity asks.
  std::uint32_t Place(std::uint32_t capacity);
  void MakeRoom();
  /// `ids` ascend.
  void Fill(std::uint32_t ref, const std::uint32_t* ids, std::uint32_t count);

 private:
  AlignedVector<TriangleBlock>& blocks_;
  const AlignedVector<TriangleRecord>& records_;
  const bool small_;
  std::size_t next_;      // block
  std::size_t half_ = 0;  // the unused half of a block, as an index; 0 if there is none
};

}  // namespace lanelight
