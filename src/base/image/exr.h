// OpenEXR files with arbitrary named channels.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "src/base/image/image.h"

namespace lanelight {

/// One channel to write: width * height values, row 0 at the top.
struct ExrPlane {
  std::string name;  // e.g. "R", "variance.R", "samples"
  std::vector<float> values;
  bool always_float = false;  // 32 bit even in a half file (sample counts)
};

/// Where the pixels lie in the full image, and how they are stored.
struct ExrOptions {
  bool half = false;                    // finite values beyond +-65504 saturate there
  int x0 = 0, y0 = 0;                   // data window origin
  int full_width = 0, full_height = 0;  // display window; 0: the data's own size
  std::map<std::string, ImageAttribute> attributes;
  std::string color_space = "srgb";  // of R, G, B; another one is said by chromaticities
};

/// Writes the file atomically: the old file stays until the new one is complete. ZIP
/// compressed scan lines. Throws InputError with the system's reason if it cannot.
void WriteExr(const std::string& path, int width, int height,
              const std::vector<ExrPlane>& planes, const ExrOptions& options = {});

/// Reads all channels as float, "R","G","B","A" first, the others by name.
Image ReadExr(const std::string& path);

/// Reads the named channels in this order; a missing one is an InputError that lists
/// those of the file.
Image ReadExr(const std::string& path, const std::vector<std::string>& channels);

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
