// Values of float textures while a scene is loaded: heights, by which meshes are
// displaced.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/base/image/image.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// One texture and what it is made of. Keeps a reference to the list of textures.
class HeightTexture {
 public:
  /// Reads the images that the texture needs; InputError at the texture if one cannot be.
  /// Requires that `Problem` is empty.
  HeightTexture(const std::vector<Texture>& textures, Index texture);

  /// Why the texture cannot be evaluated here, in words, or "": constant, scale, mix,
  /// checkerboard and imagemap over surface coordinates can be.
  static std::string Problem(const std::vector<Texture>& textures, Index texture);

  /// The value at surface coordinates (u, v): of images, level 0.
  double At(double u, double v) const { return Value(texture_, u, v); }

 private:
  // One value per texel, row 0 at the top, decoded.
  struct Texels {
    int width = 0, height = 0;
    std::vector<float> values;
  };
  void Load(Index texture);
  double Value(Index texture, double u, double v) const;
  double ImageValue(const Texture& texture, const Texels& texels, double s,
                    double t) const;

  const std::vector<Texture>& textures_;
  Index texture_;
  std::map<Index, Texels> images_;
};

}  // namespace lanelight
