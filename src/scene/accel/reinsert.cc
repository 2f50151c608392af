#include "src/scene/accel/binary_tree.h"

#include <algorithm>
#include <queue>
#include <vector>

#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

// Every round looks for places for this part of all subtrees, those with the largest
// boxes, and some more in small trees; and for each among this many times as many. More
// rounds or larger parts gain less than 1 %.
constexpr int kRounds = 3;
constexpr std::size_t kSearchDivisor = 64, kSearchExtra = 512, kSearchCandidates = 4;
// Largest number of nodes visited per subtree; without it, overlapping boxes need all.
constexpr int kMaxVisitedNodes = 4096;
// Moves keep to this depth, which a tree fresh from the builder may exceed by little.
constexpr int kMaxDepth = 64;
constexpr std::size_t kSearchGrain = 64;
// The owner of pairs that a round does not reach.
constexpr std::uint32_t kUnknown = 0xffffffffu;

AccelBox Join(AccelBox a, const AccelBox& b) {
  a.Extend(b);
  return a;
}

// A subtree and its better sibling.
struct Move {
  float gain = 0;
  std::size_t rank = 0;  // of the subtree by its size
  std::uint32_t from = 0, to = 0;
};

// A subtree that a search has yet to look at, and what placing another one in it saves
// but for the boxes from here on.
struct Open {
  std::uint32_t at;
  float saved;
};

// Nodes are named by their places in the tree, which come in pairs of siblings; a move
// changes what lies at four of them.
class Reinserter {
 public:
  // Appends to `changed` the places whose subtrees change.
  Reinserter(BinaryTree& tree, std::vector<std::uint32_t>& changed)
      : tree_(tree),
        changed_(changed),
        owner_(tree.size() / 2, kUnknown),
        large_(FindLarge()) {}

  // Makes the moves that gain most; returns their number.
  std::size_t MakeBestMoves() {
    std::vector<Move> moves(large_.size());
    ParallelForRange(moves.size(), kSearchGrain, [&](std::size_t begin, std::size_t end) {
      std::vector<Open> stack;
      for (std::size_t i = begin; i < end; ++i) moves[i] = Search(i, stack);
    });
    std::erase_if(moves, [](const Move& m) { return m.to == 0; });
    std::ranges::sort(moves, [](const Move& a, const Move& b) {
      return a.gain != b.gain ? a.gain > b.gain : a.rank < b.rank;
    });
    std::size_t made = 0;
    for (const Move& m : moves) made += MoveIfBetter(m);
    return made;
  }

 private:
  std::uint32_t Parent(std::uint32_t at) const { return owner_[at / 2]; }
  static std::uint32_t Sibling(std::uint32_t at) { return at ^ 1; }
  float Area(std::uint32_t at) const { return tree_[at].box.HalfArea(); }
  int Depth(std::uint32_t at) const {
    int depth = 0;
    for (; at != 0; at = Parent(at)) ++depth;
    return depth;
  }
  bool IsIn(std::uint32_t at, std::uint32_t subtree) const {
    while (at != 0 && at != subtree) at = Parent(at);
    return at == subtree;
  }

  // The subtrees with the largest boxes, the largest first; notes the owners of these and
  // of more.
  std::vector<std::uint32_t> FindLarge() {
    struct Node {
      float area;
      std::size_t rank;  // unlike places, these do not depend on what threads built
      std::uint32_t at;
      bool operator<(const Node& n) const {
        return area != n.area ? area < n.area : rank > n.rank;
      }
    };
    const std::size_t count = tree_.size() / kSearchDivisor + kSearchExtra;
    std::vector<std::uint32_t> large;
    std::priority_queue<Node> open;
    std::size_t rank = 0;
    open.push({Area(0), rank++, 0});
    for (std::size_t i = 0; i < kSearchCandidates * count && !open.empty(); ++i) {
      const std::uint32_t at = open.top().at;
      open.pop();
      if (at != 0 && large.size() < count) large.push_back(at);
      const std::uint32_t child = tree_[at].child;
      if (child == 0) continue;
      owner_[child / 2] = at;
      open.push({Area(child), rank++, child});
      open.push({Area(child + 1), rank++, child + 1});
    }
    return large;
  }

  // The best place for a subtree; to = 0 if it has that already. Goes up from the subtree
  // and looks into the other side of every ancestor.
  Move Search(std::size_t rank, std::vector<Open>& stack) const {
    const std::uint32_t from = large_[rank];
    Move best{kMinGain * Area(0), rank, from, 0};
    const std::uint32_t beside = Sibling(from);
    std::uint32_t above = Parent(from), other = beside;
    float saved = Area(above);  // that node is not needed then
    AccelBox rest;              // what `above` holds without the subtree
    int visits = kMaxVisitedNodes;
    for (;;) {
      stack.assign(1, {other, saved});
      VisitChildren(from, beside, stack, visits, best);
      rest.Extend(tree_[other].box);
      if (above == 0) return best;
      if (above != Parent(from)) saved += Area(above) - rest.HalfArea();
      other = Sibling(above);
      above = Parent(above);
    }
  }

  void VisitChildren(std::uint32_t from, std::uint32_t beside, std::vector<Open>& stack,
                     int& visits, Move& best) const {
    const AccelBox& box = tree_[from].box;
    const float area = box.HalfArea();
    while (!stack.empty() && --visits >= 0) {
      const auto [at, saved] = stack.back();
      stack.pop_back();
      if (!(saved - area > best.gain)) continue;  // no box there is smaller
      const BinaryNode& n = tree_[at];
      const float joint = Join(n.box, box).HalfArea();
      if (saved - joint > best.gain && at != beside) {
        best.gain = saved - joint;
        best.to = at;
      }
      if (n.IsLeaf() || owner_[n.child / 2] == kUnknown) continue;
      const float below = saved - (joint - n.box.HalfArea());
      stack.push_back({n.child, below});
      stack.push_back({n.child + 1, below});
    }
  }

  // Earlier moves may have changed what lies here and there: what is gained is measured.
  bool MoveIfBetter(const Move& m) {
    const std::uint32_t beside = Sibling(m.from), above = Parent(m.from);
    if (m.to == beside || m.to == above || IsIn(m.to, m.from)) return false;
    const int higher = std::max(tree_[m.from].height, tree_[m.to].height);
    if (Depth(m.to) + 1 + higher > kMaxDepth) return false;
    if (Relink(m.from, m.to) < 0) return true;
    Relink(m.from | 1, above);
    return false;
  }

  // Puts the subtree at `from` beside that at `to`: it lies at `from | 1` then, and what
  // was beside it where their parent was. Returns how the sum of areas changes.
  double Relink(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t above = Parent(from), pair = from & ~1u;
    const BinaryNode moved = tree_[from], sibling = tree_[Sibling(from)];
    double change = -double{Area(above)};
    PlaceNode(above, sibling);
    if (above != 0) change += Refit(Parent(above));
    const BinaryNode neighbour = tree_[to];
    PlaceNode(pair, neighbour);
    PlaceNode(pair | 1, moved);
    tree_[to].child = pair;
    owner_[pair / 2] = to;
    tree_[to].box = AccelBox();
    return change + Refit(to);
  }

  void PlaceNode(std::uint32_t at, const BinaryNode& node) {
    tree_[at] = node;
    if (!node.IsLeaf()) owner_[node.child / 2] = at;
    changed_.push_back(at);  // as the place may be where it was
  }

  // Updates a node and its ancestors; returns the change of the sum of areas.
  double Refit(std::uint32_t at) {
    for (double change = 0;; at = Parent(at)) {
      BinaryNode& n = tree_[at];
      const double before = n.box.HalfArea();
      const BinaryNode &a = tree_[n.child], &b = tree_[n.child + 1];
      n.box = Join(a.box, b.box);
      n.height = std::max(a.height, b.height) + 1;
      n.begin = 0;
      n.end = (a.end - a.begin) + (b.end - b.begin);
      change += n.box.HalfArea() - before;
      changed_.push_back(at);
      if (at == 0) return change;
    }
  }

  // Smaller gains are rounding errors.
  static constexpr float kMinGain = 1e-6f;

  BinaryTree& tree_;
  std::vector<std::uint32_t>& changed_;
  std::vector<std::uint32_t> owner_;  // of each pair: the parent's place
  std::vector<std::uint32_t> large_;  // places of large subtrees
};

}  // namespace

void ReinsertSubtrees(BinaryTree& tree) {
  // Sums of areas that overflow order nothing.
  constexpr float kLargest = 1e30f;
  if (tree[0].IsLeaf() || !(tree[0].box.HalfArea() < kLargest)) return;
  std::vector<std::uint32_t> changed;
  Reinserter reinserter(tree, changed);
  for (int i = 0; i < kRounds; ++i) {
    if (reinserter.MakeBestMoves() == 0) break;
  }
  std::ranges::sort(changed);
  changed.erase(std::ranges::unique(changed).begin(), changed.end());
  // Children before their parents.
  std::ranges::sort(changed, {}, [&](std::uint32_t at) { return tree[at].height; });
  for (const std::uint32_t at : changed) PlanCollapse(tree, at);
}

}  // namespace lanelight
