// Guides that nobody has trained: lopsided densities in cells of random bounds, for tests
// of what must hold for any guide.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "src/core/vec.h"
#include "src/prepare/guide_cell.h"

namespace lanelight::test {

struct RandomGuideOptions {
  unsigned seed = 1;
  int levels = 5;             // of the tree; one leaf in eight ends it earlier
  double decades = 4;         // over which masses spread
  double even = 0.1;          // share of the density that is even
  double low = -2, high = 2;  // where positions are divided
};

class RandomGuideMaker {
 public:
  explicit RandomGuideMaker(const RandomGuideOptions& options)
      : options_(options), random_(options.seed) {
    guide_.nodes.resize(1);
    levels_.push_back(options.levels);
    for (std::uint32_t node = 0; node < guide_.nodes.size(); ++node) Fill(node);
  }
  Guide Take() { return std::move(guide_); }

 private:
  double Between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  void Fill(std::uint32_t node) {
    const int levels = levels_[node];  // below it
    if (levels == 0 || random_() % 8 == 0) {
      guide_.nodes[node].next = Guide::Node::kLeaf | Cell() << 3;
      return;
    }
    const std::uint32_t axis = random_() % 6;
    const double at =
        axis < 3 ? Between(options_.low, options_.high) : Between(-0.7, 0.7);
    const auto children = static_cast<std::uint32_t>(guide_.nodes.size());
    guide_.nodes.resize(children + 2);
    guide_.nodes[node] = {static_cast<float>(at), axis | children << 3};
    levels_.insert(levels_.end(), 2, levels - 1);
  }
  std::uint32_t Cell() {
    std::vector<double> masses(kGuideSquares);
    for (double& m : masses) m = std::pow(10, Between(-options_.decades, 0));
    return AppendGuideCell(std::span<const double, kGuideSquares>(masses), options_.even,
                           static_cast<float>(Between(0.2, 0.8)), guide_);
  }

  const RandomGuideOptions options_;
  std::mt19937 random_;
  std::vector<int> levels_;  // by node
  Guide guide_;
};

inline Guide RandomGuide(const RandomGuideOptions& options = {}) {
  return RandomGuideMaker(options).Take();
}

/// The cell of a point, one node after the other.
inline std::uint32_t CellByHand(const Guide& guide, Vec3f p, Vec3f n) {
  const float values[6] = {p.x, p.y, p.z, n.x, n.y, n.z};
  std::uint32_t node = 0;
  for (;;) {
    const Guide::Node& at = guide.nodes[node];
    const std::uint32_t axis = at.next & 7, target = at.next >> 3;
    if (axis == Guide::Node::kLeaf) return target;
    node = values[axis] < at.at ? target : target + 1;
  }
}

}  // namespace lanelight::test
