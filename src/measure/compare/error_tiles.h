// Where two images differ most.
#pragma once

#include <vector>

#include "src/measure/compare/linear_image.h"

namespace lanelight {

struct ErrorTile {
  int x = 0, y = 0, width = 0, height = 0;  // in pixels
  double relmse = 0;  // mean of (a - b)^2 / (b^2 + kRelativeEpsilon) over its values
  double share = 0;   // of the sum of all tiles
};

/// The tiles (of LayoutOf()) that add most to the relative MSE, largest first; at most
/// `most`, and none without an error. Invalid values are left out.
std::vector<ErrorTile> WorstTiles(const LinearImage& test, const LinearImage& reference,
                                  std::size_t most);

}  // namespace lanelight
