#include "src/accel/triangle_blocks.h"

#include <cmath>

#include "src/accel/leaf_vertices.h"
#include "src/core/check.h"

namespace lanelight {
namespace {

bool FitsLeaf(const BuildItem* items, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records) {
  LeafVertices vertices;
  std::uint8_t corner[3];
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!vertices.Add(records[items[i].id], corner)) return false;
  }
  return true;
}

void FillLeaf(TriangleLeaf& leaf, const std::uint32_t* ids, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records) {
  LeafVertices vertices;
  for (std::uint32_t lane = 0; lane < kLeafTriangles; ++lane) {
    std::uint8_t corner[3] = {0, 0, 0};
    if (lane < count) LL_CHECK(vertices.Add(records[ids[lane]], corner));
    for (int k = 0; k < 3; ++k) leaf.corner[k][lane] = corner[k];
    leaf.prim[lane] = lane < count ? ids[lane] : kEmptyRef;
  }
  for (int a = 0; a < 3; ++a) {
    for (int i = 0; i < kLeafVertices; ++i) {
      leaf.vertex[a][i] = vertices.at(a, i < vertices.count() ? i : 0);
    }
  }
  leaf.count = count;
  leaf.used = (1u << count) - 1;
  leaf.vertices = static_cast<std::uint32_t>(vertices.count());
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

LeafLimit TriangleLimit(const AlignedVector<TriangleRecord>& records) {
  return {kLeafTriangles,
          [&](const BuildItem* items, std::uint32_t count, std::uint32_t capacity) {
            return capacity <= SeparateLeaf::kLanes ? count <= capacity
                                                    : FitsLeaf(items, count, records);
          },
          [&](const BuildItem* items, std::uint32_t count) {
            return TypicalLeaf(items, count, records);
          },
          records.data()};
}

TriangleBlocks::TriangleBlocks(AlignedVector<TriangleBlock>& blocks,
                               const AlignedVector<TriangleRecord>& records)
    : blocks_(blocks), records_(records), next_(blocks.size()) {}

std::uint32_t TriangleBlocks::Place(std::uint32_t capacity) {
  LL_CHECK_LT(next_, std::size_t{kRefIndex});
  const std::uint32_t kind = capacity <= SeparateLeaf::kLanes ? kSeparateBit : 0;
  return kind | static_cast<std::uint32_t>(next_++);
}

void TriangleBlocks::MakeRoom() { blocks_.resize(next_); }

void TriangleBlocks::Fill(std::uint32_t ref, const std::uint32_t* ids,
                          std::uint32_t count) {
  TriangleBlock& block = blocks_[ref & kRefIndex];
  if (ref & kSeparateBit) {
    FillLeaf(block.separate, ids, count, records_);
  } else {
    FillLeaf(block.shared, ids, count, records_);
  }
}

}  // namespace lanelight
