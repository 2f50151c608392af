// The normal of a ribbon.
#pragma once

#include <cmath>

#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// What the normals of the ends of a ribbon count at u, 0 to 1 along it: turning evenly
/// from one to the other.
inline void RibbonWeights(const RibbonRecord& ribbon, float u, float weight[2]) {
  weight[0] = 1 - u;
  weight[1] = u;
  if (ribbon.angle == 0) return;
  for (int k = 0; k < 2; ++k) {
    weight[k] = std::sin(weight[k] * ribbon.angle) * ribbon.inverse_sine;
  }
}

/// The normal at u, unit but for roundings.
inline void RibbonNormal(const RibbonRecord& ribbon, float u, float n[3]) {
  float weight[2];
  RibbonWeights(ribbon, u, weight);
  for (int a = 0; a < 3; ++a) {
    n[a] = weight[0] * ribbon.normal[0][a] + weight[1] * ribbon.normal[1][a];
  }
}

}  // namespace lanelight
