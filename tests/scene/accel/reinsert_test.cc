// Reinsertion of subtrees (binary_tree.h): what it keeps, and that it makes trees better.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <random>
#include <set>

#include "src/scene/accel/binary_tree.h"

namespace lanelight {
namespace {

AccelBox BoxAt(Vec3f p, float size) { return {p, p + Vec3f{size, size, size}}; }

// Fills the subtree at `at` over boxes[begin, end), divided in the middle: if they are in
// random order, a bad tree.
void Fill(BinaryTree& tree, std::uint32_t at, const std::vector<AccelBox>& boxes,
          std::uint32_t begin, std::uint32_t end) {
  BinaryNode& n = tree[at];
  n.begin = begin;
  n.end = end;
  for (std::uint32_t i = begin; i < end; ++i) n.box.Extend(boxes[i]);
  if (end - begin > 1) {
    n.child = tree.AddPair();
    const std::uint32_t middle = (begin + end) / 2;
    Fill(tree, n.child, boxes, begin, middle);
    Fill(tree, n.child + 1, boxes, middle, end);
    n.height = std::max(tree[n.child].height, tree[n.child + 1].height) + 1;
  } else {
    n.area = static_cast<float>(begin);
  }
  PlanCollapse(tree, at);
}

// Calls f(place) for every node below `at` and for itself, children first.
void ForEachNode(const BinaryTree& tree, std::uint32_t at,
                 const std::function<void(std::uint32_t)>& f) {
  if (!tree[at].IsLeaf()) {
    ForEachNode(tree, tree[at].child, f);
    ForEachNode(tree, tree[at].child + 1, f);
  }
  f(at);
}

double InnerArea(const BinaryTree& tree) {
  double sum = 0;
  ForEachNode(tree, 0, [&](std::uint32_t at) {
    if (!tree[at].IsLeaf()) sum += tree[at].box.HalfArea();
  });
  return sum;
}

bool Equal(const AccelBox& a, const AccelBox& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.lo[k] != b.lo[k] || a.hi[k] != b.hi[k]) return false;
  }
  return true;
}

// Returns whether every node says of its children what they are, and is planned.
void CheckNodes(BinaryTree& tree, const std::vector<AccelBox>& boxes) {
  std::multiset<std::uint32_t> items;
  ForEachNode(tree, 0, [&](std::uint32_t at) {
    const BinaryNode n = tree[at];
    if (n.IsLeaf()) {
      items.insert(n.begin);
      CHECK(n.end == n.begin + 1);
      CHECK(Equal(n.box, boxes[n.begin]));
      CHECK(n.height == 0);
      CHECK(n.area == static_cast<float>(n.begin));
      return;
    }
    const BinaryNode &a = tree[n.child], &b = tree[n.child + 1];
    AccelBox box = a.box;
    box.Extend(b.box);
    CHECK(Equal(n.box, box));
    CHECK(n.end - n.begin == (a.end - a.begin) + (b.end - b.begin));
    CHECK(n.height == std::max(a.height, b.height) + 1);
    CHECK(n.area == a.area + b.area);
    PlanCollapse(tree, at);
    CHECK(std::equal(n.cost, n.cost + kBvhWidth, tree[at].cost));
    CHECK(std::equal(n.left, n.left + kBvhWidth, tree[at].left));
  });
  CHECK(items.size() == boxes.size());
  CHECK(std::set(items.begin(), items.end()).size() == boxes.size());
}

}  // namespace

TEST_CASE("reinsertion keeps the leaves of random trees and makes them better",
          "[accel]") {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> u(0, 1);
  for (const std::uint32_t count : {2u, 3u, 10u, 100u, 3000u}) {
    std::vector<AccelBox> boxes;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float size = i % 10 == 0 ? 0.5f * u(engine) : 0.01f;
      boxes.push_back(BoxAt({u(engine), u(engine), u(engine)}, size));
    }
    BinaryTree tree(count);
    Fill(tree, 0, boxes, 0, count);
    const double before = InnerArea(tree);
    ReinsertSubtrees(tree);
    INFO(count << " leaves");
    CheckNodes(tree, boxes);
    CHECK(InnerArea(tree) <= before * (1 + 1e-6));
    // All subtrees of 100 leaves are tried, of 3000 a tenth.
    if (count == 100) CHECK(InnerArea(tree) < 0.75 * before);
    if (count == 3000) CHECK(InnerArea(tree) < 0.9 * before);
  }
}

TEST_CASE("reinsertion undoes the one mistake of a tree", "[accel]") {
  // Two distant groups of boxes, of each of which one is in the other's half.
  std::vector<AccelBox> boxes;
  for (int i = 0; i < 16; ++i) {
    const bool second = (i >= 8) != (i == 3 || i == 12);
    boxes.push_back(BoxAt({(second ? 100.0f : 0.0f) + static_cast<float>(i), 0, 0}, 1));
  }
  BinaryTree tree(boxes.size());
  Fill(tree, 0, boxes, 0, 16);
  ReinsertSubtrees(tree);
  CheckNodes(tree, boxes);
  for (int side = 0; side < 2; ++side) {
    const BinaryNode& n = tree[tree[0].child + static_cast<std::uint32_t>(side)];
    CHECK(n.end - n.begin == 8);
    CHECK(n.box.hi.x - n.box.lo.x < 20);
  }
}

TEST_CASE("reinsertion skips boxes whose areas overflow", "[accel]") {
  std::vector<AccelBox> boxes;
  for (int i = 0; i < 40; ++i) {
    boxes.push_back(BoxAt({1e25f * static_cast<float>(i * 7 % 40), 0, 0}, 1e24f));
  }
  BinaryTree tree(boxes.size());
  Fill(tree, 0, boxes, 0, 40);
  ReinsertSubtrees(tree);
  CheckNodes(tree, boxes);
}

}  // namespace lanelight
