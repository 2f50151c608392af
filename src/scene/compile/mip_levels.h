// Pyramids of images (Williams 1983): each level is the one before it, averaged over
// areas to half its size (rounded down, at least 1), down to a single texel.
#pragma once

#include "src/scene/compiled/texture_table.h"

namespace lanelight {

/// Appends the levels to the image's own array and fills level_width, level_height and
/// level_begin. Averages are of decoded values; images of bytes keep bytes, each the
/// nearest one of `decode` (256 increasing values), so that a level of them has errors of
/// half a step and a pyramid a third of the image's bytes. Levels are computed from each
/// other before they are rounded. Every level has the mean of the image.
void AddMipLevels(const float* decode, TextureImage& image);

}  // namespace lanelight
