// Fills the leaves of trees of triangles, and of trees of spheres, disks and curves.
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

  /// Returns the reference, without kLeafBit, of the next leaf of this capacity.
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

inline void SetLane(SphereBlock& block, int lane, const SphereRecord& r) {
  for (int a = 0; a < 3; ++a) block.center[a][lane] = r.center[a];
  block.radius[lane] = r.radius;
}
inline void ClearLane(SphereBlock& block, int lane) {
  for (auto& axis : block.center) axis[lane] = axis[0];
  block.radius[lane] = -1;
}
inline void SetLane(DiskBlock& block, int lane, const DiskRecord& r) {
  for (int a = 0; a < 3; ++a) {
    block.center[a][lane] = r.center[a];
    block.normal[a][lane] = r.normal[a];
  }
  block.radius[lane] = r.radius;
  block.inner_radius[lane] = r.inner_radius;
}
inline void ClearLane(DiskBlock& block, int lane) {
  for (int a = 0; a < 3; ++a) {
    block.center[a][lane] = block.center[a][0];
    block.normal[a][lane] = block.normal[a][0];
  }
  block.radius[lane] = -1;
  block.inner_radius[lane] = 0;
}

/// Appends the leaves of a tree of spheres or disks to `blocks`, as TriangleBlocks does.
/// Record i has id first_id + i.
template <typename Records, typename Block>
class RoundBlocks {
 public:
  RoundBlocks(AlignedVector<Block>& blocks, const Records& records,
              std::uint32_t first_id)
      : blocks_(blocks), records_(records), first_id_(first_id), next_(blocks.size()) {}

  std::uint32_t Place(std::uint32_t) { return static_cast<std::uint32_t>(next_++); }
  void MakeRoom() { blocks_.resize(next_); }
  void Fill(std::uint32_t ref, const std::uint32_t* ids, std::uint32_t count) {
    Block& block = blocks_[ref];
    for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
      block.prim[lane] = lane < count ? ids[lane] : kEmptyRef;
      if (lane < count) {
        SetLane(block, lane, records_[ids[lane] - first_id_]);
      } else {
        ClearLane(block, lane);
      }
    }
  }

 private:
  AlignedVector<Block>& blocks_;
  const Records& records_;
  std::uint32_t first_id_;
  std::size_t next_;
};

}  // namespace lanelight
