// The vertices that the triangles of a leaf share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "src/scene/accel/builder.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// A number that equal vertices have in common (0 and -0 count as different).
inline std::uint32_t HashOf(const float p[3]) {
  std::uint32_t bits[3];
  std::memcpy(bits, p, sizeof(bits));
  const std::uint32_t hash =
      bits[0] * 0x9e3779b1u + bits[1] * 0x85ebca6bu + bits[2] * 0xc2b2ae35u;
  return hash ^ hash >> 15;
}

/// The distinct vertices of a leaf, in order of appearance.
class LeafVertices {
 public:
  explicit LeafVertices(int most) : most_(most) {}

  /// Fills `corner` as in SharedLeaf; false if there are more than `most`.
  bool Add(const TriangleRecord& triangle, std::uint8_t corner[3]) {
    for (int k = 0; k < 3; ++k) {
      const int i = Find(triangle.p[k]);
      if (i == most_) return false;
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
    if (count_ == most_) return most_;
    std::memcpy(p_[count_], p, sizeof(p_[count_]));
    slot_[at] = static_cast<std::uint8_t>(count_ + 1);
    return count_++;
  }

  const int most_;
  float p_[kLeafTriangles][3];
  std::uint8_t slot_[kSlots] = {};  // by hash: index of a vertex + 1, 0 = none
  int count_ = 0;
};

/// Returns how many triangles a shared leaf of at most `most` typically holds, limited by
/// its lanes or vertices. Vertices are distinguished by a hash.
inline std::uint32_t TypicalLeaf(const BuildItem* items, std::uint32_t count,
                                 const AlignedVector<TriangleRecord>& records,
                                 std::uint32_t most) {
  constexpr std::uint32_t kSlots = 512, kMost = kSlots / 6;
  std::uint32_t slots[kSlots] = {};
  std::uint32_t vertices = 0;
  count = std::min(count, kMost);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const auto& p : records[items[i].id].p) {
      const std::uint32_t hash = HashOf(p) | 1;  // 0 is a free slot
      std::uint32_t at = hash * 0x2c1b3c6du / (0xffffffffu / kSlots + 1);
      while (slots[at] != 0 && slots[at] != hash) at = (at + 1) % kSlots;
      vertices += slots[at] == 0;
      slots[at] = hash;
    }
  }
  return std::clamp<std::uint32_t>(most * count / vertices, 1, most);
}

}  // namespace lanelight
