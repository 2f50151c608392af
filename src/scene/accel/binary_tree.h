// The binary tree that the builder makes, its improvement, and its collapse to wide
// nodes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "src/scene/accel/builder.h"
#include "src/scene/geometry/accel.h"

namespace lanelight {

struct BinaryNode {
  AccelBox box;
  std::uint32_t begin = 0, end = 0;  // items: see ReinsertSubtrees
  std::uint32_t child = 0;           // the first of two in a row; 0 = leaf
  std::uint32_t capacity = 0;        // as in LeafRange, if it is a leaf
  int height = 0;                    // levels below
  float area = 0;                    // of its triangles; 0 for other shapes
  /// Cost of the subtree as at most i + 1 wide nodes and leaves side by side, and the
  /// number of these in the left child: see PlanCollapse.
  float cost[kBvhWidth];
  std::uint8_t left[kBvhWidth];

  bool IsLeaf() const { return child == 0; }
};

/// Nodes, added in pairs by any thread, children behind their parents. Chunks are added
/// on demand and stay in place; most trees need far fewer nodes than the possible 2n.
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

/// Fills `cost`, `left` and, above leaves, `area` of `node`, whose subtree is complete
/// and whose children are planned. A ray meets a node with a probability proportional to
/// its surface, so the cost of a forest is the sum of half areas times kWideNodeCost or
/// kLeafCost. The best forest of at most i trees under a node combines forests of k and i
/// - k trees under its children. One tree is a wide node over the best forest of 8
/// (Ylitie, Karras and Laine 2017, section 3.1).
void PlanCollapse(BinaryTree& tree, std::uint32_t node);

/// Appends the planned tree to `nodes`, and its leaves to `leaves`. `single`: leaf
/// references are the ids of items, of which leaves hold one each.
Bvh Collapse(const BinaryTree& tree, const std::vector<BuildItem>& items, bool single,
             AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves);

/// Removes the largest subtrees of a planned tree and inserts each where the sum of the
/// half areas of inner nodes falls most (Bittner, Hapala and Havran 2013). Leaves stay.
/// Positions are searched in parallel and moves are made in sequence (after Meister and
/// Bittner 2018), except those that no longer gain. The result does not depend on the
/// number of threads. Inner nodes keep the number of their items, not their range.
/// Changed nodes are planned anew.
void ReinsertSubtrees(BinaryTree& tree);

/// Statistics of a child of a wide node, by slot. All 0 for an unused slot.
struct ChildOdds {
  float entered = 0;  // probability that a line through the node enters it
  float blocks = 0;   // that what is in it blocks a line that enters it
  float cost = 0;     // of following such a line through it
};

/// Returns the probability that triangles of total `area` block a line that enters a box.
/// A line crosses surfaces in a convex body 2 area / (surface of the body) times on
/// average (Cauchy and Crofton: Santalo 1976, chapter 14), taken to be independent.
float BlockingOdds(float area, float half_area_of_box);

/// Sets `shadow_octants` and `shadow_first` of a node. The first hit may end a shadow
/// ray. The cost of an order is therefore the sum over children of the cost of following
/// rays that nothing before has blocked (after Nah and Manocha 2014, "SATO: Surface Area
/// Traversal Order for Shadow Ray Tracing"). The best first slot is used if it saves
/// enough over the order along rays.
void SetBlockerOrder(const ChildOdds (&odds)[kBvhWidth], WideNode& node);

}  // namespace lanelight
