// Small images that lights of tests shine with.
#pragma once

#include <functional>
#include <string>

#include "src/base/image/exr.h"
#include "src/scene/description/description.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight::test {

/// Writes width x height texels as EXR; the file lives as long as the tests.
inline std::string Picture(const std::string& name, int width, int height,
                           const std::function<Rgb(int x, int y)>& texel) {
  static const TemporaryFolder folder;
  std::vector<ExrPlane> planes = {{"R", {}, true}, {"G", {}, true}, {"B", {}, true}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        planes[static_cast<std::size_t>(c)].values.push_back(
            static_cast<float>(texel(x, y)[c]));
      }
    }
  }
  WriteExr(folder.File(name), width, height, planes);
  return folder.File(name);
}

/// Texels of some contrast, none of them alike.
inline Rgb Patchwork(int x, int y) {
  return {0.2 + ((3 * x + 5 * y) % 7) * 0.4, 0.1 + ((x + 2 * y) % 5) * 0.5,
          0.3 + ((2 * x + 3 * y) % 4) * 0.7};
}

}  // namespace lanelight::test
