// Where light comes from, learned by training passes (src/wavefront/train_guide.cc) and
// then frozen: a density of directions for every cell of space and orientation, in a form
// that lanes read with few gathers.
//
// Space: a binary tree over position and normal, up to kGuideDepth levels. Directions: in
// each cell a quadtree over the square of the equal-area octahedral map (Clarberg 2008;
// kernels/warp/octahedral-inl.h), flattened to exactly kGuideLeaves squares, so that
//   sampling   finds a leaf by its cumulative mass (log2 kGuideLeaves steps), then a
//   point
//              in its square
//   density    finds the leaf of a direction in a grid of kGuideGrid^2 squares
// A leaf's density is constant: mass / (share of the square * 4 pi).
#pragma once

#include <cstdint>

#include "src/core/aligned.h"

namespace lanelight {

inline constexpr int kGuideLeaves = 64;  // of each cell; exactly
inline constexpr int kGuideGrid = 32;    // squares along a side: no leaf is smaller
inline constexpr int kGuideDepth = 20;   // levels of the tree over space

struct Guide {
  struct Node {
    float at = 0;            // of an inner node: values below it go to the first child
    std::uint32_t next = 7;  // axis | (first child, or cell) << 3
    // Axes 0, 1, 2: position; 3, 4, 5: normal on the side that the path sees; 7: a leaf,
    // whose cell it names. Children are neighbours. A NaN goes to the second child.
    static constexpr std::uint32_t kLeaf = 7;
  };
  AlignedVector<Node> nodes;  // the root is the first; empty where nothing is guided

  // cell * kGuideLeaves + leaf; leaves of a cell in Z order of their squares
  AlignedVector<float> cumulative;  // mass of the leaves up to it; the last one's is 1
  AlignedVector<float> pdf_sa;      // > 0 everywhere
  AlignedVector<std::uint32_t> square;  // x | y << 8 | side << 16, in squares of the grid
  // (cell * kGuideGrid + y) * kGuideGrid + x: the leaf that covers a square of the grid
  AlignedVector<std::uint8_t> leaf;
  // cell: probability with which the guide proposes, in [0, 1); 0 = nothing is known
  AlignedVector<float> fraction;

  std::size_t cells() const { return fraction.size(); }
};

}  // namespace lanelight
