// Sample points of each policy outside a render, for tests and benchmarks.
#pragma once

#include <cstdint>

#include "src/strategy/run_parameters.h"

namespace lanelight {

struct PointsQuery {
  Points points = Points::kSobol;
  std::uint32_t seed = 0, pixel = 0, group_size = 1, key = 0;
  std::uint32_t first_sample = 0, count = 0;
};

/// Writes `count` points; u0 and u1 need room for a full vector more.
void ProbePoints(const PointsQuery& query, float* u0, float* u1);

}  // namespace lanelight
