// The packets of tev's protocol (Thomas Müller, github.com/Tom94/tev),
// which pbrt-v4's --display-server speaks as well: all numbers little-endian; the length
// of the packet, itself included, in 32 bits; a byte of its type; the fields; texts end
// in a zero.
#pragma once

#include <span>
#include <string>

#include "src/base/image/pixel_rect.h"

namespace lanelight {

/// CreateImage (type 4): an image of channels R, G, B under this name, or an empty one
/// again if there is one of that name.
std::string CreateImagePacket(const std::string& name, int width, int height);

/// UpdateImage with offsets and strides (type 6): colours of the pixels of `place`, row
/// by row, three values each.
std::string UpdateImagePacket(const std::string& name, const PixelRect& place,
                              std::span<const float> rgb);

}  // namespace lanelight
