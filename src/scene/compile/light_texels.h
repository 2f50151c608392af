// Images that lights shine with.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/base/image/image.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// A file of a light, for messages.
struct LightFile {
  const SourceLocation& where;
  const char* what;  // such as "environment image"
  const std::string& path;
};

/// Throws InputError at the light: `<what> "<path>": <message>`.
[[noreturn]] void FailAtLight(const LightFile& file, const std::string& message);

/// Reads the image. Throws InputError at the light.
Image ReadLightImage(const LightFile& file);

/// Throws InputError at the light if the size is not that of an octahedral map.
void RequireSquareMap(const LightFile& file, int width, int height);

/// Linear texels as stored, three values each, bytes decoded as sRGB. Negative values,
/// which filters leave in photographs, become zero as in pbrt, with a note unless `notes`
/// is null. Throws InputError for values that are not finite and images without
/// colours (src/base/image/image.h).
AlignedVector<float> LightTexels(const LightFile& file, const Image& image,
                                 std::vector<Note>* notes);

/// Fills the images of a light table; what several lights share is kept once.
class LightImageTable {
 public:
  LightImageTable(LightTable& table, std::vector<Note>& notes)
      : table_(table), notes_(notes) {}

  enum class Use { kColor, kGrey };  // kGrey: the mean of the channels
  /// Returns the image of a file, with axes 0. Throws InputError at the light.
  LightImage Load(const LightFile& file, Use use);
  std::uint32_t Add(const LightImage& image);

  /// Mean of weight(column, row) * texel.
  template <class Weight>
  Rgb Mean(const LightImage& image, const Weight& weight) const {
    Rgb sum;
    const float* texel = &table_.texels[3 * static_cast<std::size_t>(image.first)];
    for (int row = 0; row < image.height; ++row) {
      for (int column = 0; column < image.width; ++column, texel += 3) {
        sum += weight(column, row) * Rgb{texel[0], texel[1], texel[2]};
      }
    }
    return sum / (static_cast<double>(image.width) * image.height);
  }
  Rgb Mean(const LightImage& image) const {
    return Mean(image, [](int, int) { return 1.0; });
  }

 private:
  void AddWhite();  // the first image, if there is none

  LightTable& table_;
  std::vector<Note>& notes_;
  std::map<std::pair<std::string, Use>, LightImage> loaded_;
};

}  // namespace lanelight
