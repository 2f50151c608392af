#include "src/scene/compile/light_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/base/core/error.h"
#include "src/base/image/image.h"
#include "src/scene/compile/texture_programs.h"

namespace lanelight {
namespace {

// Values of an image that cannot be emitted. Negative ones, which filters leave in
// photographs, become zero, as in pbrt; so does what is not a number.
struct BadValues {
  std::size_t negative = 0, not_a_number = 0;
  float minimum = 0;

  float Cut(float v) {
    not_a_number += std::isnan(v);
    negative += v < 0;
    if (v < minimum) minimum = v;
    return v > 0 ? v : 0.0f;
  }
  void AddNotes(const LightFile& file, std::size_t values,
                std::vector<Note>& notes) const {
    const auto add = [&](std::size_t count, const std::string& what) {
      if (count == 0) return;
      notes.push_back({file.where, fmt::format("{} of {} values of the {} are {} and "
                                               "count as 0",
                                               count, values, file.what, what)});
    };
    add(negative, fmt::format("negative (the least is {})", minimum));
    add(not_a_number, "not a number");
  }
};

void MakeGrey(AlignedVector<float>& rgb) {
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const float mean = (rgb[i] + rgb[i + 1] + rgb[i + 2]) / 3;
    rgb[i] = rgb[i + 1] = rgb[i + 2] = mean;
  }
}

}  // namespace

Image ReadLightImage(const LightFile& file) {
  try {
    return ReadImage(file.path);
  } catch (const InputError& e) {
    throw InputError(file.where, std::string(file.what) + ": " + WithoutPrefix(e));
  }
}

void RequireSquareMap(const LightFile& file, int width, int height) {
  if (width == height && width > 0) return;
  FailAtLight(file, fmt::format("{} x {} pixels; supported are square equal-area "
                                "octahedral maps (pbrt-v4: \"imgtool makeequiarea\" "
                                "converts a latitude-longitude map)",
                                width, height));
}

void FailAtLight(const LightFile& file, const std::string& message) {
  throw InputError(file.where,
                   fmt::format("{} \"{}\": {}", file.what, file.path, message));
}

AlignedVector<float> LightTexels(const LightFile& file, const Image& image,
                                 std::vector<Note>* notes) {
  const auto channels = ColorChannels(image);
  if (!channels) FailAtLight(file, NoColorChannels(image));
  const std::size_t texels = static_cast<std::size_t>(image.width) * image.height;
  std::array<float, 256> decode;
  for (int i = 0; i < 256; ++i) {
    decode[static_cast<std::size_t>(i)] =
        static_cast<float>(DecodeByte(i, Encoding::kSrgb, 0));
  }
  BadValues bad;
  AlignedVector<float> rgb(3 * texels);
  for (std::size_t i = 0; i < texels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = i * static_cast<std::size_t>(image.channels) +
                             static_cast<std::size_t>((*channels)[c]);
      const float v = image.is_bytes() ? decode[image.bytes[at]] : image.pixels[at];
      if (std::isinf(v)) {
        const auto width = static_cast<std::size_t>(image.width);
        FailAtLight(file, fmt::format("the value {} at pixel ({}, {}); only finite "
                                      "radiance is supported",
                                      v, i % width, i / width));
      }
      rgb[3 * i + c] = bad.Cut(v);
    }
  }
  if (notes != nullptr) bad.AddNotes(file, rgb.size(), *notes);
  return rgb;
}

LightImage LightImageTable::Load(const LightFile& file, Use use) {
  const auto [at, fresh] = loaded_.try_emplace({file.path, use}, LightImage{});
  if (!fresh) return at->second;
  const Image image = ReadLightImage(file);
  AlignedVector<float> rgb = LightTexels(file, image, &notes_);
  if (use == Use::kGrey) MakeGrey(rgb);
  AddWhite();
  // Kernels count the values in 32 bits.
  if (table_.texels.size() + rgb.size() > std::numeric_limits<std::int32_t>::max()) {
    FailAtLight(file, "the images of all lights together have more than 7e8 pixels");
  }
  at->second.first = static_cast<std::int32_t>(table_.texels.size() / 3);
  at->second.width = image.width;
  at->second.height = image.height;
  table_.texels.insert(table_.texels.end(), rgb.begin(), rgb.end());
  return at->second;
}

void LightImageTable::AddWhite() {
  if (!table_.images.empty()) return;
  table_.texels = {1, 1, 1};
  LightImage white = {};
  white.width = white.height = 1;
  table_.images.push_back(white);
}

std::uint32_t LightImageTable::Add(const LightImage& image) {
  AddWhite();
  table_.images.push_back(image);
  return static_cast<std::uint32_t>(table_.images.size()) - 1;
}

}  // namespace lanelight
