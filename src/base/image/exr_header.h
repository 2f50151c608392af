// What an EXR file says of itself, without its pixels.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "src/base/image/image.h"

namespace lanelight {

struct ExrChannel {
  std::string name, type;  // "half", "float" or "uint"
  int x_sampling = 1, y_sampling = 1;
};

/// A part of a file; most have one, without a name.
struct ExrPart {
  std::string name, kind;  // "scanlineimage", "tiledimage", "deepscanline", "deeptile"
  std::string compression;
  std::array<int, 4> data_window{}, display_window{};  // x0, y0, x1, y1, all inclusive
  std::vector<ExrChannel> channels;                    // R, G, B and A first
  std::map<std::string, ImageAttribute> attributes;    // those of strings and numbers
  std::vector<std::string> other_attributes;  // "chromaticities (chromaticities)"

  int width() const { return data_window[2] - data_window[0] + 1; }
  int height() const { return data_window[3] - data_window[1] + 1; }
};

/// All parts of a file, of any kind that OpenEXR reads. Throws InputError, with the path,
/// for one that cannot be read.
std::vector<ExrPart> ReadExrHeader(const std::string& path);

}  // namespace lanelight
