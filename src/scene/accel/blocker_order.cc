#include "src/scene/accel/binary_tree.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

// Least relative gain that justifies leaving the order along rays, which keeps the rays
// of a packet together longest.
constexpr float kMinGain = 0.005f;

// Returns the expected cost of visiting slots 0 ^ first, 1 ^ first, ...
float CostFrom(std::uint32_t first, const ChildOdds (&odds)[kBvhWidth]) {
  float open = 1, cost = 0;
  for (std::uint32_t k = 0; k < kBvhWidth; ++k) {
    const ChildOdds& child = odds[k ^ first];
    cost += open * child.entered * child.cost;
    open *= 1 - child.entered * child.blocks;
  }
  return cost;
}

}  // namespace

float BlockingOdds(float area, float half_area_of_box) {
  return half_area_of_box > 0 ? 1 - std::exp(-area / half_area_of_box) : 0.0f;
}

void SetBlockerOrder(const ChildOdds (&odds)[kBvhWidth], WideNode& node) {
  node.shadow_octants = kBvhWidth - 1;
  node.shadow_first = 0;
  float along_rays = 0, minimum = INFINITY;
  std::uint32_t best = 0;
  for (std::uint32_t first = 0; first < kBvhWidth; ++first) {
    const float cost = CostFrom(first, odds);
    along_rays += cost / kBvhWidth;
    if (cost < minimum) minimum = cost, best = first;
  }
  // The negation also catches areas that overflow.
  if (!(minimum < (1 - kMinGain) * along_rays)) return;
  node.shadow_octants = 0;
  node.shadow_first = best;
}

}  // namespace lanelight
