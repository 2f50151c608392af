#include "src/base/image/image.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <variant>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/decode.h"
#include "src/base/image/exr.h"

namespace lanelight {
namespace {

std::string LowerExtension(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos || path[dot] == '/') return "";
  std::string extension = path.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace

int Image::FindChannel(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

void CheckImageSize(const std::string& path, long long width, long long height) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide ||
      static_cast<std::size_t>(width * height) > kMaxImagePixels) {
    throw InputError(
        "{}: image size {} x {} is not supported; sides must be 1 to {} and the image at "
        "most {} pixels",
        path, width, height, kMaxImageSide, kMaxImagePixels);
  }
}

void CheckImageFits(const std::string& path, long long width, long long height,
                    double pixels_per_byte, std::size_t bytes) {
  CheckImageSize(path, width, height);
  if (static_cast<double>(width * height) <=
      pixels_per_byte * static_cast<double>(bytes)) {
    return;
  }
  throw InputError(
      "{}: the image file is truncated: its {} bytes cannot hold {} x {} pixels", path,
      bytes, width, height);
}

std::vector<std::string> ChannelNames(int count) {
  std::vector<std::string> names =
      count < 3 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  if (count % 2 == 0) names.emplace_back("A");
  return names;
}

Image MakeImage(int width, int height, const std::vector<std::string>& names) {
  LL_CHECK(width > 0 && height > 0 && !names.empty());
  Image image;
  image.width = width;
  image.height = height;
  image.channels = static_cast<int>(names.size());
  image.names = names;
  image.pixels.resize(image.Offset(0, height, 0));
  return image;
}

Image ReadImage(const std::string& path) {
  const std::string extension = LowerExtension(path);
  if (extension == "exr") return ReadExr(path);
  if (extension == "pfm") return ReadPfm(path);
  if (extension == "hdr") return ReadHdr(path);
  return DecodeBytes(path, ReadWholeFile(path));
}

double SrgbToLinear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double LinearToSrgb(double linear) {
  return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

std::size_t ReplaceNotFinite(Image* image) {
  std::size_t count = 0;
  for (float& value : image->pixels) {
    if (std::isfinite(value)) continue;
    value = std::isnan(value) ? 0 : std::copysign(kLargestHalf, value);
    ++count;
  }
  return count;
}

std::optional<std::array<int, 3>> ColorChannels(const Image& image) {
  const auto has = [&](const char* name) { return image.FindChannel(name) >= 0; };
  if (has("R") && has("G") && has("B")) {
    return {{image.FindChannel("R"), image.FindChannel("G"), image.FindChannel("B")}};
  }
  const bool part = has("X") || has("RY") || has("BY");
  const int grey = image.channels == 1 && !has("A") ? 0 : image.FindChannel("Y");
  if (part || grey < 0) return std::nullopt;
  return {{grey, grey, grey}};
}

double LinearValue(const Image& image, int x, int y, int channel) {
  if (!image.is_bytes()) return image.At(x, y, channel);
  return SrgbToLinear(image.bytes[image.Offset(x, y, channel)] / 255.0);
}

std::string NoColorChannels(const Image& image) {
  return fmt::format(
      "its channels ({}) are not a colour image; supported: R, G and B, or Y, or one "
      "channel other than A",
      fmt::join(image.names, ", "));
}

int VarianceExponent(double largest) {
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  const int exponent = std::ilogb(largest);
  if (exponent >= -60 && exponent <= 125) return 0;
  return exponent - 125;
}

double VarianceUnit(const Image& image) {
  const auto found = image.attributes.find(kVarianceExponent);
  if (found == image.attributes.end()) return 1;
  const int* exponent = std::get_if<int>(&found->second);
  return exponent != nullptr ? std::ldexp(1.0, *exponent) : 1;
}

}  // namespace lanelight
