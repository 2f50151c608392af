// Images in memory, and readers for every format that scenes and comparisons use. Row 0
// is the top row. Errors are InputErrors that begin with the path.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
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

/// Replaces infinite values: the largest number of half precision.
inline constexpr float kLargestHalf = 65504;

/// Sets values that are not a number to 0 and infinite ones to +-kLargestHalf. Returns
/// how many; images of bytes have none.
std::size_t ReplaceNotFinite(Image* image);

/// Returns the indices of R, G and B, or three times that of a grey channel: Y, or the
/// only channel. Empty for other images: A is coverage, and Y beside X, RY or BY is a
/// part of a colour.
std::optional<std::array<int, 3>> ColorChannels(const Image& image);

/// Returns a sample; bytes are decoded as sRGB.
double LinearValue(const Image& image, int x, int y, int channel);

/// Returns an error text for an image without ColorChannels.
std::string NoColorChannels(const Image& image);

// Attributes of images with variances. Variances outside of the range of float are stored
// in another unit, a power of two; ordinary images have no such attribute.
/// An int: a variance is the value of its channel times 2 to this power.
inline constexpr const char* kVarianceExponent = "varianceExponent";

/// An int: independent observations that the variance of a pixel rests on, of the pixel
/// that has the fewest.
inline constexpr const char* kObservations = "observations";

/// A float above 1, where pixels have paths in common: the sum over all pixels of the
/// squared correlation of their errors with one's own (SampleGroups::dependents).
inline constexpr const char* kDependentPixels = "dependentPixels";

/// An int above 0: pixels that have no sample and are black.
inline constexpr const char* kEmptyPixels = "emptyPixels";

/// Returns the exponent to write with, if the largest finite variance of the image is
/// `largest`; 0 for 0 and for 1e-18 to 8e37. Beyond that, the largest one comes to lie
/// near the upper end of the range of float, so that few others become zero.
int VarianceExponent(double largest);

/// Returns the factor on the variances of an image that was read.
double VarianceUnit(const Image& image);

/// Tone mapping of one channel: value * 2^exposure, clamped to [0, 1], sRGB-encoded,
/// rounded to 8 bits. No other curve: what is in range is exact. NaN is not allowed.
std::uint8_t TonemapToByte(double value, double exposure);

/// Writes channels R, G, B (or the single channel Y) of a float image as 8-bit RGB,
/// atomically. A pixel with a NaN becomes magenta, so that it is seen. Throws InputError
/// if it cannot be written or has neither R, G, B nor Y.
void WritePng(const std::string& path, const Image& image, double exposure = 0);

}  // namespace lanelight
