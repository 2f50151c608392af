// Leaves of triangles of both kinds, read alike.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "src/scene/accel/builder.h"

namespace lanelight {

struct LeafView {
  bool separate = false;
  std::vector<std::uint32_t> prim;           // by lane
  std::vector<std::array<Vec3f, 3>> corner;  // of each
  AccelBox box;                              // what the boxes on the way have in common
};

/// The used lanes of a leaf; checks what else its kind promises.
inline LeafView ReadLeaf(const Accel& accel, std::uint32_t ref) {
  LeafView view;
  const auto add = [&](const auto& leaf, std::uint32_t count) {
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      view.prim.push_back(leaf.prim[lane]);
      auto& corner = view.corner.emplace_back();
      for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) corner[k][a] = leaf.vertex[a][leaf.VertexOf(k, lane)];
      }
    }
  };
  const auto add_shared = [&](const auto& leaf) {
    CHECK(leaf.used == (1u << leaf.count) - 1);
    CHECK(leaf.count <= accel.leaf_triangles);
    CHECK(leaf.vertices <= accel.leaf_triangles);
    add(leaf, leaf.count);
    for (std::uint32_t lane = 0; lane < leaf.count; ++lane) {
      for (int k = 0; k < 3; ++k) CHECK(leaf.VertexOf(k, lane) < leaf.vertices);
    }
  };
  const bool small = accel.leaf_triangles == SmallLeaf::kLanes;
  const std::uint32_t index = ref & kRefIndex;
  const TriangleBlock& block = accel.triangle_blocks[small ? index / 2 : index];
  view.separate = ref & kSeparateBit;
  if (view.separate) {
    if (small) CHECK(index % 2 == 0);
    const SeparateLeaf& leaf = block.separate;
    std::uint32_t count = 0;
    while (count < SeparateLeaf::kLanes && leaf.prim[count] != kEmptyRef) ++count;
    add(leaf, count);
    for (std::uint32_t lane = count; lane < SeparateLeaf::kLanes; ++lane) {
      CHECK(leaf.prim[lane] == kEmptyRef);
      for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
          CHECK(std::isnan(leaf.vertex[a][leaf.VertexOf(k, lane)]));
        }
      }
    }
  } else if (small) {
    add_shared(block.small[index % 2]);
  } else {
    add_shared(block.shared);
  }
  return view;
}

/// The leaves below `ref`, in the order of the tree.
inline void CollectLeaves(const Accel& accel, std::uint32_t ref, const AccelBox& outer,
                          std::vector<LeafView>& leaves) {
  if (ref == kEmptyRef) return;
  if (ref & kLeafBit) {
    leaves.push_back(ReadLeaf(accel, ref));
    leaves.back().box = outer;
    return;
  }
  const WideNode& node = accel.nodes[ref];
  for (int c = 0; c < kBvhWidth; ++c) {
    AccelBox box;
    for (int a = 0; a < 3; ++a) {
      box.lo[a] = std::max(outer.lo[a], node.bounds[a][0][c]);
      box.hi[a] = std::min(outer.hi[a], node.bounds[a][1][c]);
    }
    CollectLeaves(accel, node.child[c], box, leaves);
  }
}

/// The leaves of the world's triangles.
inline std::vector<LeafView> LeavesOf(const Accel& accel) {
  std::vector<LeafView> leaves;
  const Vec3f all{INFINITY, INFINITY, INFINITY};
  CollectLeaves(accel, accel.groups[0].root, {-all, all}, leaves);
  return leaves;
}

inline bool SameBytes(const auto& a, const auto& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

}  // namespace lanelight
