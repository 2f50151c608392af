#include "src/measure/compare/linear_image.h"

#include "src/base/core/error.h"
#include "src/base/image/image.h"

namespace lanelight {

LinearImage LinearOf(const Image& image) {
  const auto channels = ColorChannels(image);
  if (!channels) throw InputError(NoColorChannels(image));
  LinearImage out = {image.width, image.height, {}};
  for (int c = 0; c < 3; ++c) {
    out.planes[c].reserve(out.pixels());
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        out.planes[c].push_back(
            static_cast<float>(LinearValue(image, x, y, (*channels)[c])));
      }
    }
  }
  return out;
}

}  // namespace lanelight
