// Where light comes from, learned by training passes (src/train/train_guide.cc) and
// then frozen: a density of directions for every cell of space and orientation, in a form
// that lanes read with few gathers.
//
// Space: a binary tree over position and normal, up to kGuideDepth levels. Directions: a
// grid over the square that the hemisphere above the path's own surface is mapped to
// (src/prepare/guide_square.h). Even masses make the density of the cosine: what the
// guide knows is the light times the cosine, and no direction lies below the surface.
//   sampling   finds a row by the cumulative masses of rows, a square by those in the row
//   density    one gather: mass of the square over its share, times what the map does
#pragma once

#include <cstddef>
#include <cstdint>

#include "src/core/aligned.h"

namespace lanelight {

inline constexpr int kGuideGrid = 16;   // squares along a side
inline constexpr int kGuideDepth = 20;  // levels of the tree over space
inline constexpr std::size_t kGuideSquares = std::size_t{kGuideGrid} * kGuideGrid;
/// Bounds of a cell: of the rows, then of the squares of each row.
inline constexpr std::size_t kGuideBounds = kGuideGrid + kGuideSquares;

struct Guide {
  struct Node {
    float at = 0;            // of an inner node: values below it go to the first child
    std::uint32_t next = 7;  // axis | (first child, or cell) << 3
    // Axes 0, 1, 2: position; 3, 4, 5: normal on the side that the path sees; 7: a leaf,
    // whose cell it names. Children are neighbours. A NaN goes to the second child.
    static constexpr std::uint32_t kLeaf = 7;
  };
  AlignedVector<Node> nodes;  // the root is the first; empty where nothing is guided

  // cell * kGuideBounds + row: mass of the rows up to it; and kGuideGrid * (row + 1) +
  // column further: mass of the squares of the row up to it, of all of the row. The last
  // one's is 1.
  AlignedVector<float> cumulative;
  // cell * kGuideSquares + row * kGuideGrid + column: density over [-1, 1]^2, > 0
  AlignedVector<float> density;
  // cell: probability with which the guide proposes, in [0, 1); 0 = nothing is known
  AlignedVector<float> fraction;

  std::size_t cells() const { return fraction.size(); }
};

}  // namespace lanelight
