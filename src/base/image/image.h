// Images in memory, and readers for every format that scenes and comparisons use. Row 0
// is the top row. Errors are InputErrors that begin with the path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/core/vec.h"

namespace lanelight {

using ImageAttribute = std::variant<std::string, double, int>;

/// Interleaved samples: exactly one of `pixels` and `bytes` is filled, with
/// width * height * channels entries. Bytes are as stored in the file, not decoded.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<std::string> names;  // one per channel: "R", "G", "B", "A", "Y", ...
  AlignedVector<float> pixels;
  AlignedVector<std::uint8_t> bytes;
  std::map<std::string, ImageAttribute> attributes;  // string, float, int ones of EXR

  bool is_bytes() const { return !bytes.empty(); }
  std::size_t Offset(int x, int y, int channel) const {
    return (static_cast<std::size_t>(y) * width + x) * channels + channel;
  }
  /// Float sample; only for images that are not bytes.
  float At(int x, int y, int channel) const { return pixels[Offset(x, y, channel)]; }
  float& At(int x, int y, int channel) { return pixels[Offset(x, y, channel)]; }
  /// Index of a channel, -1 if absent.
  int FindChannel(const std::string& name) const;
};

/// Largest accepted width or height, and number of pixels.
inline constexpr int kMaxImageSide = 1 << 16;
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 28;

/// Throws InputError if a size is not in 1..kMaxImageSide or too large in total.
void CheckImageSize(const std::string& path, long long width, long long height);

/// An image without content: `channels` named as given, all samples zero.
Image MakeImage(int width, int height, const std::vector<std::string>& names);

/// Reads .exr, .pfm and .hdr (float) by the extension; in other files the content
/// decides: PNG, QOI, JPEG, TGA, BMP, GIF (the first frame), PSD, PGM, PPM (bytes; 16-bit
/// samples are read as 8-bit ones). Channels: "Y" or "Y","A" or "R","G","B" or
/// "R","G","B","A"; EXR: all channels of the file, colour first.
/// Throws InputError: missing, unreadable, truncated, absurd, or unknown format.
Image ReadImage(const std::string& path);

/// PFM: "PF" (colour) or "Pf" (grey), both byte orders.
Image ReadPfm(const std::string& path);

/// PFM, little endian; 1 or 3 float channels. Written atomically.
void WritePfm(const std::string& path, const Image& image);

/// The linear value of an sRGB-encoded one in [0, 1] (IEC 61966-2-1), and its inverse.
double SrgbToLinear(double encoded);
double LinearToSrgb(double linear);

}  // namespace lanelight
