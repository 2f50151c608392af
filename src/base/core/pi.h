// Kernels have one of their own, in float (kernels/simd/math-inl.h).
#pragma once

#include <numbers>

namespace lanelight {

inline constexpr double kPi = std::numbers::pi;

}  // namespace lanelight
