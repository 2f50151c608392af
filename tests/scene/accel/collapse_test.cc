// The collapse to wide nodes against all ways of choosing them.
#include "src/scene/accel/binary_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace lanelight {
namespace {

// A tree over `leaves` random points, split at random; nodes are planned bottom up.
class RandomTree {
 public:
  RandomTree(std::uint32_t leaves, std::mt19937& engine) : tree_(leaves) {
    std::uniform_real_distribution<float> uniform(0, 1);
    for (std::uint32_t i = 0; i < leaves; ++i) {
      const Vec3f p{uniform(engine), uniform(engine), uniform(engine)};
      BuildItem item{{}, i};
      item.box.Extend(p);
      item.box.Extend(p + 0.2f * Vec3f{uniform(engine), uniform(engine), 0.5f});
      items_.push_back(item);
    }
    Fill(0, 0, leaves, engine);
  }

  /// Expected cost of the wide tree whose inner nodes are the root and the inner nodes
  /// chosen by bits; infinite if one has more than 8 children.
  double Cost(std::uint32_t chosen) const {
    double cost = 0;
    for (std::size_t i = 0; i < inner_.size(); ++i) {
      if (i > 0 && !(chosen >> i & 1)) continue;
      const BinaryNode& n = tree_[inner_[i]];
      if (Children(n.child, chosen) + Children(n.child + 1, chosen) > kBvhWidth) {
        return INFINITY;
      }
      cost += 22.0 * n.box.HalfArea();
    }
    for (const BuildItem& item : items_) cost += 30.0 * item.box.HalfArea();
    return cost;
  }

  double MinCost() const {
    double minimum = INFINITY;
    for (std::uint32_t chosen = 0; chosen < 1u << inner_.size(); ++chosen) {
      minimum = std::min(minimum, Cost(chosen));
    }
    return minimum;
  }

  /// Cost of the nodes that Collapse writes.
  double CollapsedCost() {
    AlignedVector<WideNode> nodes;
    std::vector<LeafRange> leaves;
    Collapse(tree_, items_, false, nodes, leaves);
    REQUIRE(leaves.size() == items_.size());
    double cost = 22.0 * tree_[0].box.HalfArea();
    for (const WideNode& node : nodes) {
      for (int c = 0; c < kBvhWidth; ++c) {
        if (node.child[c] == kEmptyRef) continue;
        AccelBox box;
        for (int side = 0; side < 2; ++side) {
          box.Extend(Vec3f{node.bounds[0][side][c], node.bounds[1][side][c],
                           node.bounds[2][side][c]});
        }
        cost += (node.child[c] & kLeafBit ? 30.0 : 22.0) * box.HalfArea();
      }
    }
    return cost;
  }

 private:
  void Fill(std::uint32_t at, std::uint32_t begin, std::uint32_t end,
            std::mt19937& engine) {
    BinaryNode& n = tree_[at];
    n.begin = begin;
    n.end = end;
    for (std::uint32_t i = begin; i < end; ++i) n.box.Extend(items_[i].box);
    if (end - begin > 1) {
      inner_.push_back(at);
      n.child = tree_.AddPair();
      const std::uint32_t middle = begin + 1 + engine() % (end - begin - 1);
      Fill(n.child, begin, middle, engine);
      Fill(n.child + 1, middle, end, engine);
    }
    PlanCollapse(tree_, at);
  }

  // Children of a wide node below `at`.
  int Children(std::uint32_t at, std::uint32_t chosen) const {
    const BinaryNode& n = tree_[at];
    if (n.IsLeaf()) return 1;
    const auto i = std::find(inner_.begin(), inner_.end(), at) - inner_.begin();
    if (chosen >> i & 1) return 1;
    return Children(n.child, chosen) + Children(n.child + 1, chosen);
  }

  std::vector<BuildItem> items_;
  BinaryTree tree_;
  std::vector<std::uint32_t> inner_;  // the root first
};

}  // namespace

TEST_CASE("no choice of wide nodes costs less than the planned one", "[accel]") {
  std::mt19937 engine(1);
  for (const std::uint32_t leaves : {2u, 5u, 8u, 9u, 10u, 11u, 12u, 13u}) {
    for (int k = 0; k < 4; ++k) {
      RandomTree tree(leaves, engine);
      INFO(leaves << " leaves, tree " << k);
      CHECK(tree.CollapsedCost() == Approx(tree.MinCost()).epsilon(1e-5));
    }
  }
}

}  // namespace lanelight
