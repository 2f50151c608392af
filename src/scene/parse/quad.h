// Four corners to two triangles.
#pragma once

#include <array>

#include "src/base/core/vec.h"

namespace lanelight {

struct QuadSplit {
  bool is_flat = true;    // the corners are coplanar within the rounding of text input
  bool is_simple = true;  // false: the outline crosses itself, no split covers it
  std::array<int, 6> corners;  // two triangles, oriented like the outline
};

/// `ring`: the corners in order around the outline. Splits along the diagonal 0-2, or for
/// an outline that is concave at corner 1 or 3 along 1-3. Collapsed corners are fine.
QuadSplit SplitQuad(const std::array<Vec3d, 4>& ring);

}  // namespace lanelight
