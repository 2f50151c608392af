#include "src/base/image/color_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lanelight {

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
      "its channels ({}) are no colour; supported are R, G and B, or a grey one: Y, or a "
      "single one other than A",
      fmt::join(image.names, ", "));
}

}  // namespace lanelight
