// What tests of lights with images share: sizes of images, and renders with every way of
// sampling against the reference.
#pragma once

#include <cstdint>

#include "tests/agreement/agreement.h"

namespace lanelight::test {

inline constexpr std::uint32_t kImagePaths = 4001;  // samples of one place or scene
inline constexpr int kWide = 6, kHigh = 4;          // of an oblong image
inline constexpr int kSquare = 8;                   // of a map of directions

/// 2048 samples per pixel by a strategy, as it is told on the command line.
stat::ImageEstimate RenderBy(const SceneDescription& scene, const char* strategy);

/// Requires that all ways to sample lights that know of their emission, as far as the
/// scene takes them, agree with the reference, and its two estimators with each other.
/// Family-wise false alarms of a scene's comparisons: 1e-5.
void CheckStrategies(const SceneDescription& scene);

}  // namespace lanelight::test
