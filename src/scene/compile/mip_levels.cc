#include "src/scene/compile/texture_programs.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lanelight {
namespace {

struct Level {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

Level Decode(const float* decode, const TextureImage& image) {
  Level out{image.width, image.height, {}};
  if (image.rgba8.empty()) {
    out.rgb.assign(image.rgb.begin(), image.rgb.end());
    return out;
  }
  out.rgb.reserve(3 * image.rgba8.size());
  for (const std::uint32_t word : image.rgba8) {
    for (int c = 0; c < 3; ++c) out.rgb.push_back(decode[word >> (8 * c) & 255]);
  }
  return out;
}

// Returns the length of the part of texel i in [begin, end).
double Overlap(int i, double begin, double end) {
  return std::min(i + 1.0, end) - std::max<double>(i, begin);
}

// Texels that are `stride` floats apart.
template <class T>
struct Line {
  T* first;
  int count;
  std::ptrdiff_t stride;
};

// Averages the texels of a line to fewer.
void Shrink(const Line<const float>& in, const Line<float>& out) {
  const double size = static_cast<double>(in.count) / out.count;
  for (int j = 0; j < out.count; ++j) {
    const double begin = j * size, end = std::min<double>(begin + size, in.count);
    double sum = 0;
    for (int i = static_cast<int>(begin); i < end; ++i) {
      sum += Overlap(i, begin, end) * in.first[i * in.stride];
    }
    out.first[j * out.stride] = static_cast<float>(sum / size);
  }
}

Level Halve(const Level& in) {
  const int w = std::max(1, in.width / 2), h = std::max(1, in.height / 2);
  Level rows{w, in.height, {}}, out{w, h, {}};
  rows.rgb.resize(std::size_t{3} * w * in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int c = 0; c < 3; ++c) {
      Shrink({&in.rgb[std::size_t{3} * y * in.width + c], in.width, 3},
             {&rows.rgb[std::size_t{3} * y * w + c], w, 3});
    }
  }
  out.rgb.resize(std::size_t{3} * w * h);
  for (int x = 0; x < 3 * w; ++x) {
    Shrink({&rows.rgb[x], in.height, 3 * w}, {&out.rgb[x], h, 3 * w});
  }
  return out;
}

std::uint32_t NearestByte(const float* decode, float value) {
  const float* upper = std::lower_bound(decode, decode + 256, value);
  if (upper == decode) return 0;
  if (upper == decode + 256) return 255;
  const bool below = value - upper[-1] < *upper - value;
  return static_cast<std::uint32_t>(upper - decode) - (below ? 1 : 0);
}

void Append(const float* decode, const Level& level, TextureImage& image) {
  const bool bytes = !image.rgba8.empty();
  const std::size_t begin = bytes ? image.rgba8.size() : image.rgb.size() / 3;
  image.level_width.push_back(level.width);
  image.level_height.push_back(level.height);
  image.level_begin.push_back(static_cast<std::int32_t>(begin));
  if (!bytes) {
    image.rgb.insert(image.rgb.end(), level.rgb.begin(), level.rgb.end());
    return;
  }
  for (std::size_t i = 0; i < level.rgb.size(); i += 3) {
    std::uint32_t word = 0xff000000u;
    for (int c = 0; c < 3; ++c) {
      word |= NearestByte(decode, level.rgb[i + c]) << (8 * c);
    }
    image.rgba8.push_back(word);
  }
}

}  // namespace

void AddMipLevels(const float* decode, TextureImage& image) {
  image.level_width = {image.width};
  image.level_height = {image.height};
  image.level_begin = {0};
  Level level = Decode(decode, image);
  while (level.width > 1 || level.height > 1) {
    level = Halve(level);
    Append(decode, level, image);
  }
}

}  // namespace lanelight
