// Progressive multi-jittered (0,2) points.
#pragma once

#include <cstdint>

namespace lanelight {

/// Points of one stored sequence.
inline constexpr std::uint32_t kPmj02Points = 1024;

}  // namespace lanelight
