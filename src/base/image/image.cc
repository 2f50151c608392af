#include "src/base/image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/base/image/decode.h"
#include "src/base/image/exr.h"
#include "src/base/image/stb.h"

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
    throw InputError(fmt::format(
        "{}: image size {} x {} is not supported; sides must be 1 to {} and the image at "
        "most {} pixels",
        path, width, height, kMaxImageSide, kMaxImagePixels));
  }
}

void CheckImageFits(const std::string& path, long long width, long long height,
                    double pixels_per_byte, std::size_t bytes) {
  CheckImageSize(path, width, height);
  if (static_cast<double>(width * height) <=
      pixels_per_byte * static_cast<double>(bytes)) {
    return;
  }
  throw InputError(fmt::format(
      "{}: the image file is truncated: its {} bytes cannot hold {} x {} pixels", path,
      bytes, width, height));
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

}  // namespace lanelight
