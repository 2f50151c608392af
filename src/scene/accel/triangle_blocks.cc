#include "src/scene/accel/triangle_blocks.h"

#include <cmath>
#include <utility>

#include "src/base/core/check.h"
#include "src/scene/accel/leaf_vertices.h"

namespace lanelight {
namespace {

bool FitsLeaf(const BuildItem* items, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records, int most) {
  LeafVertices vertices(most);
  std::uint8_t corner[3];
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!vertices.Add(records[items[i].id], corner)) return false;
  }
  return true;
}

template <int n>
void FillLeaf(SharedLeaf<n>& leaf, const std::uint32_t* ids, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records) {
  LeafVertices vertices(n);
  for (std::uint32_t lane = 0; lane < n; ++lane) {
    std::uint8_t corner[3] = {0, 0, 0};
    if (lane < count) LL_CHECK(vertices.Add(records[ids[lane]], corner));
    for (int k = 0; k < 3; ++k) leaf.corner[k][lane] = corner[k];
    leaf.prim[lane] = lane < count ? ids[lane] : kEmptyRef;
  }
  for (int a = 0; a < 3; ++a) {
    for (int i = 0; i < n; ++i) {
      leaf.vertex[a][i] = vertices.at(a, i < vertices.count() ? i : 0);
    }
  }
  leaf.count = static_cast<std::uint8_t>(count);
  leaf.used = static_cast<std::uint16_t>((1u << count) - 1);
  leaf.vertices = static_cast<std::uint8_t>(vertices.count());
}

void FillLeaf(SeparateLeaf& leaf, const std::uint32_t* ids, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records) {
  for (std::uint32_t lane = 0; lane < SeparateLeaf::kLanes; ++lane) {
    leaf.prim[lane] = lane < count ? ids[lane] : kEmptyRef;
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < 3; ++a) {
        leaf.vertex[a][leaf.VertexOf(k, lane)] =
            lane < count ? records[ids[lane]].p[k][a] : NAN;
      }
    }
  }
}

}  // namespace

LeafLimit TriangleLimit(const AlignedVector<TriangleRecord>& records,
                        int leaf_triangles) {
  constexpr std::uint32_t kSeparate = SeparateLeaf::kLanes;
  const auto most = static_cast<std::uint32_t>(leaf_triangles);
  // A small leaf costs about as much as a level of the tree: 0.35 to 0.75 were slower.
  const float node_cost =
      leaf_triangles == SmallLeaf::kLanes ? 1.0f : LeafLimit().node_cost;
  return {most, node_cost,
          [&records, leaf_triangles](const BuildItem* items, std::uint32_t count,
                                     std::uint32_t capacity) {
            return capacity == kSeparate
                       ? count <= kSeparate
                       : FitsLeaf(items, count, records, leaf_triangles);
          },
          [&records, most](const BuildItem* items, std::uint32_t count) {
            const std::uint32_t shared = TypicalLeaf(items, count, records, most);
            if (shared <= most / 2) return kSeparate;
            // Vertices run out before the lanes of a small leaf do.
            return shared == kSeparate ? kSeparate - 1 : shared;
          },
          records.data()};
}

TriangleBlocks::TriangleBlocks(AlignedVector<TriangleBlock>& blocks,
                               const AlignedVector<TriangleRecord>& records,
                               int leaf_triangles)
    : blocks_(blocks),
      records_(records),
      small_(leaf_triangles == SmallLeaf::kLanes),
      next_(blocks.size()) {}

std::uint32_t TriangleBlocks::Place(std::uint32_t capacity) {
  LL_CHECK_LT(2 * next_ + 1, std::size_t{kRefIndex});
  const bool separate = capacity == SeparateLeaf::kLanes;
  if (small_ && !separate && half_ != 0) {
    return static_cast<std::uint32_t>(std::exchange(half_, 0));
  }
  const std::size_t index = small_ ? 2 * next_ : next_;
  ++next_;
  if (small_ && !separate) half_ = index + 1;
  return (separate ? kSeparateBit : 0) | static_cast<std::uint32_t>(index);
}

void TriangleBlocks::MakeRoom() { blocks_.resize(next_); }

void TriangleBlocks::Fill(std::uint32_t ref, const std::uint32_t* ids,
                          std::uint32_t count) {
  const std::uint32_t index = ref & kRefIndex;
  TriangleBlock& block = blocks_[small_ ? index / 2 : index];
  if (ref & kSeparateBit) {
    FillLeaf(block.separate, ids, count, records_);
  } else if (small_) {
    FillLeaf(block.small[index % 2], ids, count, records_);
  } else {
    FillLeaf(block.shared, ids, count, records_);
  }
}

}  // namespace lanelight
