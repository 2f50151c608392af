#include "src/prepare/guide_restore.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/prepare/guide_cell.h"

namespace lanelight {
namespace {

// Kernels follow as many levels as there can be, and no node but these.
const char* TreeFault(const Guide& guide) {
  std::vector<int> depth(guide.nodes.size(), 0);
  for (std::size_t i = 0; i < guide.nodes.size(); ++i) {
    const Guide::Node& node = guide.nodes[i];
    const std::uint32_t axis = node.next & 7;
    const std::size_t next = node.next >> 3;
    if (axis == Guide::Node::kLeaf) {
      if (next >= guide.cells()) return "a leaf names a cell that is not there";
      continue;
    }
    if (axis > 5) return "a node divides an axis that is not there";
    // Children behind their parent: no path comes back.
    if (next <= i || next + 1 >= guide.nodes.size()) {
      return "a node names children that are not there";
    }
    if (!std::isfinite(node.at)) return "a node divides at no number";
    if (depth[i] == kGuideDepth) return "the tree has too many levels";
    depth[next] = depth[next + 1] = depth[i] + 1;
  }
  return nullptr;
}

// A quarter of a quarter ... of the grid.
bool IsSquare(std::uint32_t x, std::uint32_t y, std::uint32_t side) {
  return std::has_single_bit(side) && side <= kGuideGrid && x % side == 0 &&
         y % side == 0 && x + side <= kGuideGrid && y + side <= kGuideGrid;
}

// Puts leaf `leaf` of a cell into the cell's grid, and its density in place.
bool Complete(Guide& guide, std::size_t cell, std::size_t leaf) {
  const std::size_t at = cell * kGuideLeaves + leaf;
  const std::uint32_t square = guide.square[at];
  const std::uint32_t x = square & 255, y = square >> 8 & 255, side = square >> 16;
  if (!IsSquare(x, y, side)) return false;
  for (std::uint32_t v = y; v < y + side; ++v) {
    for (std::uint32_t u = x; u < x + side; ++u) {
      std::uint8_t& of = guide.leaf[cell * kGuideSquares + v * kGuideGrid + u];
      if (of != kGuideLeaves) return false;
      of = static_cast<std::uint8_t>(leaf);
    }
  }
  const double before = leaf == 0 ? 0 : double{guide.cumulative[at - 1]};
  const double bound = double{guide.cumulative[at]};
  if (!(bound > before && bound <= 1)) return false;
  const double share = double(side) * side / double(kGuideSquares);
  guide.pdf_sa[at] =
      static_cast<float>((bound - before) / (share * 4 * std::numbers::pi));
  return leaf + 1 < kGuideLeaves || bound == 1;
}

}  // namespace

std::string CompleteGuide(Guide& guide) {
  const std::size_t cells = guide.cells();
  if (guide.nodes.empty() || cells == 0) return "it is empty";
  if (guide.square.size() != cells * kGuideLeaves ||
      guide.cumulative.size() != cells * kGuideLeaves) {
    return "its cells have not all their leaves";
  }
  if (const char* fault = TreeFault(guide)) return fault;
  guide.leaf.assign(cells * kGuideSquares, kGuideLeaves);
  guide.pdf_sa.assign(cells * kGuideLeaves, 0.0f);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const float fraction = guide.fraction[cell];
    if (!(fraction >= 0 && fraction < 1)) return "a fraction is not in [0, 1)";
    std::size_t covered = 0;
    for (std::size_t leaf = 0; leaf < kGuideLeaves; ++leaf) {
      if (!Complete(guide, cell, leaf)) return "a cell's leaves are none";
      const std::size_t side = guide.square[cell * kGuideLeaves + leaf] >> 16;
      covered += side * side;
    }
    if (covered != kGuideSquares) return "a cell's leaves leave directions out";
  }
  return "";
}

}  // namespace lanelight
