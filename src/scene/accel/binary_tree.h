// The binary tree that the builder makes and src/scene/accel/collapse.h turns into wide
// nodes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "src/scene/accel/builder.h"

namespace lanelight {

struct BinaryNode {
  AccelBox box;
  std::uint32_t begin = 0, end = 0;  // items: see ReinsertSubtrees
  std::uint32_t child = 0;           // the first of two in a row; 0 = leaf
  std::uint32_t capacity = 0;        // as in LeafRange, if it is a leaf
  int height = 0;                    // levels below
  float area = 0;                    // of its triangles; 0 for other shapes
  /// What the subtree costs as at most i + 1 wide nodes and leaves side by side, and how
  /// the children share them then: see PlanCollapse.
  float cost[kBvhWidth];
  std::uint8_t left[kBvhWidth];

  bool IsLeaf() const { return child == 0; }
};

/// Nodes, added in pairs by any thread, children behind their parents. They stay where
/// they are: chunks are added as they are needed, since most trees need far fewer nodes
/// than the 2n that they may have.
class BinaryTree {
 public:
  explicit BinaryTree(std::size_t items)
      : chunks_(2 * items / kChunk + 2), next_(2) {  // the root, and an unused one
    Touch(0);
  }
  std::uint32_t AddPair() {
    const std::uint32_t at = next_.fetch_add(2, std::memory_order_relaxed);
    Touch(at / kChunk);
    return at;
  }
  /// Nodes of all pairs so far.
  std::uint32_t size() const { return next_.load(std::memory_order_relaxed); }
  BinaryNode& operator[](std::uint32_t i) {
    return chunks_[i / kChunk].nodes[i % kChunk];
  }
  const BinaryNode& operator[](std::uint32_t i) const {
    return chunks_[i / kChunk].nodes[i % kChunk];
  }

 private:
  static constexpr std::uint32_t kChunk = 4096;
  struct Chunk {
    std::once_flag made;
    std::unique_ptr<BinaryNode[]> nodes;
  };

  void Touch(std::size_t chunk) {
    std::call_once(chunks_[chunk].made, [&] {
      chunks_[chunk].nodes = std::make_unique<BinaryNode[]>(kChunk);
    });
  }

  std::vector<Chunk> chunks_;
  std::atomic<std::uint32_t> next_;
};

}  // namespace lanelight
