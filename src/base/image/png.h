// PNG output for the eye.
#pragma once

#include <cstdint>
#include <string>

#include "src/base/image/image.h"

namespace lanelight {

/// Tone mapping of one channel: value * 2^exposure, clamped to [0, 1], sRGB-encoded,
/// rounded to 8 bits. No other curve: what is in range is exact. NaN is not allowed.
std::uint8_t TonemapToByte(double value, double exposure);

/// Writes channels R, G, B (or the single channel Y) of a float image as 8-bit RGB,
/// atomically. A pixel with a NaN becomes magenta, so that it is seen. Throws InputError
/// if it cannot be written or has neither R, G, B nor Y.
void WritePng(const std::string& path, const Image& image, double exposure = 0);

}  // namespace lanelight
