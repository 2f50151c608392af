// Pyramids of images (Williams 1983): each level is the one before it, averaged over
// areas to half its size (rounded down, at least 1), down to a single texel.
#pragma once

#include "src/scene/compiled/texture_table.h"

namespace lanelight {

/// Appends the levels to the image's array and fills level_width, level_height and
/// level_begin. Averages are of decoded values. Byte images keep bytes, each the nearest
/// of `decode` (256 increasing values). Levels are computed from each other before
/// rounding, so each has an error of half a step and the mean of the image. A pyramid
/// adds a third of the image's bytes.
void AddMipLevels(const float* decode, TextureImage& image);

}  // namespace lanelight
