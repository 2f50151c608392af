// The formats that stb decodes and encodes. Use ReadImage and WritePng.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/image/image.h"

namespace lanelight {

/// Radiance HDR as float R, G, B.
Image ReadHdr(const std::string& path);

/// A PNG file of 8-bit RGB, rows from the top.
std::string EncodePng(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace lanelight
