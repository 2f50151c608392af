#include "src/scene/accel/leaf_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "src/base/core/check.h"
#include "src/scene/accel/builder.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

namespace {

// Returns a hash of a vertex (0 and -0 count as different).
std::uint32_t HashOf(const float p[3]) {
  std::uint32_t bits[3];
  std::memcpy(bits, p, sizeof(bits));
  const std::uint32_t hash =
      bits[0] * 0x9e3779b1u + bits[1] * 0x85ebca6bu + bits[2] * 0xc2b2ae35u;
  return hash ^ hash >> 15;
}

// The distinct vertices of a leaf, in order of appearance.
class LeafVertices {
 public:
  explicit LeafVertices(int max_vertices) : max_vertices_(max_vertices) {}

  // Fills `corner` as in SharedLeaf; false if there are more than `max_vertices`.
  bool Add(const TriangleRecord& triangle, std::uint8_t corner[3]) {
    for (int k = 0; k < 3; ++k) {
      const int i = Find(triangle.p[k]);
      if (i == max_vertices_) return false;
      corner[k] = static_cast<std::uint8_t>(i);
    }
    return true;
  }
  int count() const { return count_; }
  float at(int axis, int i) const { return p_[i][axis]; }

 private:
  static constexpr std::uint32_t kSlots = 64;

  int Find(const float p[3]) {
    std::uint32_t at = HashOf(p) * 0x2c1b3c6du / (0xffffffffu / kSlots + 1);
    for (; slot_[at] != 0; at = (at + 1) % kSlots) {
      const int i = slot_[at] - 1;
      if (std::memcmp(p_[i], p, sizeof(p_[i])) == 0) return i;
    }
    if (count_ == max_vertices_) return max_vertices_;
    std::memcpy(p_[count_], p, sizeof(p_[count_]));
    slot_[at] = static_cast<std::uint8_t>(count_ + 1);
    return count_++;
  }

  const int max_vertices_;
  float p_[kLeafTriangles][3];
  std::uint8_t slot_[kSlots] = {};  // by hash: index of a vertex + 1, 0 = none
  int count_ = 0;
};

// Returns how many triangles a shared leaf of at most `max_vertices` typically holds,
// limited by its lanes or vertices. Vertices are distinguished by a hash.
std::uint32_t TypicalLeaf(const BuildItem* items, std::uint32_t count,
                          const AlignedVector<TriangleRecord>& records,
                          std::uint32_t max_vertices) {
  constexpr std::uint32_t kSlots = 512, kMaxTriangles = kSlots / 6;
  std::uint32_t slots[kSlots] = {};
  std::uint32_t vertices = 0;
  count = std::min(count, kMaxTriangles);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const auto& p : records[items[i].id].p) {
      const std::uint32_t hash = HashOf(p) | 1;  // 0 is a free slot
      std::uint32_t at = hash * 0x2c1b3c6du / (0xffffffffu / kSlots + 1);
      while (slots[at] != 0 && slots[at] != hash) at = (at + 1) % kSlots;
      vertices += slots[at] == 0;
      slots[at] = hash;
    }
  }
  return std::clamp<std::uint32_t>(max_vertices * count / vertices, 1, max_vertices);
}

bool FitsLeaf(const BuildItem* items, std::uint32_t count,
              const AlignedVector<TriangleRecord>& records, int max_vertices) {
  LeafVertices vertices(max_vertices);
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
  const auto max_vertices = static_cast<std::uint32_t>(leaf_triangles);
  // A small leaf costs about as much as a level of the tree: 0.35 to 0.75 were slower.
  const float node_cost =
      leaf_triangles == SmallLeaf::kLanes ? 1.0f : LeafLimit().node_cost;
  return {max_vertices, node_cost,
          [&records, leaf_triangles](const BuildItem* items, std::uint32_t count,
                                     std::uint32_t capacity) {
            return capacity == kSeparate
                       ? count <= kSeparate
                       : FitsLeaf(items, count, records, leaf_triangles);
          },
          [&records, max_vertices](const BuildItem* items, std::uint32_t count) {
            const std::uint32_t shared = TypicalLeaf(items, count, records, max_vertices);
            if (shared <= max_vertices / 2) return kSeparate;
            // The vertices of a small leaf are full before its lanes are.
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
