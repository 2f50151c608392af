// Small image files of every kind for texture tests.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "src/base/image/exr.h"
#include "src/base/image/image.h"
#include "src/scene/description/description.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {

/// An uncompressed TGA with random bytes: 8 (grey), 24 (colour) or 32 (with alpha) bits.
inline std::string RandomTga(int width, int height, int bits, std::uint32_t seed) {
  std::string file(18, '\0');
  file[2] = static_cast<char>(bits == 8 ? 3 : 2);
  file[12] = static_cast<char>(width), file[14] = static_cast<char>(height);
  file[16] = static_cast<char>(bits), file[17] = bits == 32 ? 0x28 : 0x20;
  std::mt19937 random(seed);
  for (int i = 0; i < width * height * bits / 8; ++i) {
    file += static_cast<char>(random() & 255);
  }
  return file;
}

inline Image RandomFloats(int width, int height, int channels, std::uint32_t seed) {
  Image image = channels == 1 ? MakeImage(width, height, {"Y"})
                              : MakeImage(width, height, {"R", "G", "B"});
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 3);
  for (float& p : image.pixels) p = uniform(random);
  return image;
}

inline void WriteRandomExr(const std::string& path, int width, int height, bool alpha) {
  std::vector<ExrPlane> planes = {{"R", {}}, {"G", {}}, {"B", {}}};
  if (alpha) planes.push_back({"A", {}});
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (ExrPlane& plane : planes) {
    for (int i = 0; i < width * height; ++i) plane.values.push_back(uniform(random));
  }
  WriteExr(path, width, height, planes);
}

inline Texture ImageTexture(const std::string& path) {
  Texture t;
  t.kind = TextureKind::kImage;
  t.name = "image";
  t.path = path;
  return t;
}

inline Texture ConstantTexture(Rgb value) {
  Texture t;
  t.name = "constant";
  t.value = value;
  return t;
}

}  // namespace lanelight
