#include "src/base/image/image.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/image/atomic_file.h"
#include "src/base/image/decode.h"

namespace lanelight {

std::uint8_t TonemapToByte(double value, double exposure) {
  const double display = std::clamp(value * std::exp2(exposure), 0., 1.);
  return static_cast<std::uint8_t>(std::lround(255 * LinearToSrgb(display)));
}

void WritePng(const std::string& path, const Image& image, double exposure) {
  int channel[3] = {image.FindChannel("R"), image.FindChannel("G"),
                    image.FindChannel("B")};
  if (image.FindChannel("R") < 0) std::fill_n(channel, 3, image.FindChannel("Y"));
  if (*std::min_element(channel, channel + 3) < 0 || image.is_bytes()) {
    throw InputError(path + ": a PNG needs the float channels R, G, B or Y");
  }
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * static_cast<std::size_t>(image.width) * image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double value[3] = {image.At(x, y, channel[0]), image.At(x, y, channel[1]),
                               image.At(x, y, channel[2])};
      const bool bad =
          std::isnan(value[0]) || std::isnan(value[1]) || std::isnan(value[2]);
      for (int c = 0; c < 3; ++c) {
        rgb.push_back(bad ? (c == 1 ? 0 : 255) : TonemapToByte(value[c], exposure));
      }
    }
  }
  WriteFileAtomically(path, EncodePng(image.width, image.height, rgb));
}

}  // namespace lanelight
