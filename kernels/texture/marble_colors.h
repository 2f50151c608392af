// Control points of the colours of pbrt's marble: each four successive ones are a cubic
// Bezier curve.
#pragma once

namespace lanelight {

inline constexpr int kMarbleSegments = 6;
inline constexpr float kMarbleColors[kMarbleSegments + 3][3] = {
    {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f},
    {0.5f, 0.5f, 0.5f},   {0.6f, 0.59f, 0.58f}, {0.58f, 0.58f, 0.6f},
    {0.58f, 0.58f, 0.6f}, {0.2f, 0.2f, 0.33f},  {0.58f, 0.58f, 0.6f}};

}  // namespace lanelight
