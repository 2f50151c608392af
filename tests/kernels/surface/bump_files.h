// Height and normal maps whose slopes are known.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "src/base/image/exr.h"
#include "src/scene/description/description.h"
#include "tests/kernels/texture/texture_files.h"

namespace lanelight {

/// Writes an image of f(u, v) at the centres of size x size texels; bilinear lookups of
/// an affine f are exact where |u - 1/2|, |v - 1/2| < 1/2 - 1/(2 size).
inline void WriteGreyImage(const std::string& path, int size,
                           const std::function<double(double, double)>& f) {
  std::vector<ExrPlane> planes = {{"Y", {}}};
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      planes[0].values.push_back(
          static_cast<float>(f((i + 0.5) / size, 1 - (j + 0.5) / size)));
    }
  }
  WriteExr(path, size, size, planes);
}

/// An image of one colour.
inline void WriteColorImage(const std::string& path, Rgb color) {
  std::vector<ExrPlane> planes = {{"R", {}}, {"G", {}}, {"B", {}}};
  for (int c = 0; c < 3; ++c) {
    planes[static_cast<std::size_t>(c)].values.assign(4, static_cast<float>(color[c]));
  }
  WriteExr(path, 2, 2, planes);
}

/// Adds a float texture of the image to the scene.
inline Index AddHeights(SceneDescription& scene, const std::string& path) {
  Texture texture = ImageTexture(path);
  texture.is_float = true;
  scene.textures.push_back(texture);
  return static_cast<Index>(scene.textures.size()) - 1;
}

}  // namespace lanelight
