#include "src/scene/parse/displace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/core/suggest.h"
#include "src/base/image/image.h"

namespace lanelight {
namespace {

double Decoded(const Texture& texture, std::uint8_t byte) {
  const double v = byte / 255.0;
  switch (texture.encoding) {
    case Encoding::kSrgb:
      return SrgbToLinear(v);
    case Encoding::kLinear:
      return v;
    case Encoding::kGamma:
      return std::pow(v, texture.gamma);
  }
  return v;
}

// Channels that are averaged: alpha if anything is transparent, else the colours.
std::vector<int> ChannelsOf(const Image& image, const std::string& path) {
  if (image.channels == 1) return {0};
  const auto rgb = ColorChannels(image);
  if (!rgb) throw InputError(path + ": " + NoColorChannels(image));
  const auto [r, g, b] = *rgb;
  if (r == g) return {r};
  const int alpha = image.FindChannel("A");
  for (int y = 0; alpha >= 0 && y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t at = image.Offset(x, y, alpha);
      const bool opaque =
          image.is_bytes() ? image.bytes[at] == 255 : image.pixels[at] == 1;
      if (!opaque) return {alpha};
    }
  }
  return {r, g, b};
}

// Index after wrapping, or -1 where the texel is black.
int Wrapped(WrapMode wrap, double i, int size) {
  if (wrap == WrapMode::kRepeat) i -= std::floor(i / size) * size;
  if (wrap == WrapMode::kBlack && (i < 0 || i >= size)) return -1;
  return static_cast<int>(std::clamp(i, 0.0, size - 1.0));
}

std::vector<Index> OperandsOf(const Texture& texture) {
  std::vector<Index> operands;
  for (Index child :
       {texture.tex1.texture, texture.tex2.texture, texture.amount.texture}) {
    if (child != kNone) operands.push_back(child);
  }
  return operands;
}

}  // namespace

std::string HeightTexture::Problem(const std::vector<Texture>& textures, Index index) {
  const Texture& texture = textures[static_cast<std::size_t>(index)];
  switch (texture.kind) {
    case TextureKind::kConstant:
      return "";
    case TextureKind::kScale:
    case TextureKind::kMix:
      break;
    case TextureKind::kCheckerboard:
    case TextureKind::kImage:
      if (texture.mapping.kind == MappingKind::kUv && texture.dimension == 2 &&
          texture.wrap != WrapMode::kOctahedralSphere) {
        break;
      }
      [[fallthrough]];
    default:
      return fmt::format(
          "texture {} is not one of constant, scale, mix, checkerboard and imagemap over "
          "surface coordinates",
          Quoted(texture.name));
  }
  for (Index child : OperandsOf(texture)) {
    const std::string problem = Problem(textures, child);
    if (!problem.empty()) return problem;
  }
  return "";
}

HeightTexture::HeightTexture(const std::vector<Texture>& textures, Index texture)
    : textures_(textures), texture_(texture) {
  Load(texture);
}

void HeightTexture::Load(Index index) {
  const Texture& texture = textures_[static_cast<std::size_t>(index)];
  for (Index child : OperandsOf(texture)) Load(child);
  if (texture.kind != TextureKind::kImage || images_.contains(index)) return;
  Image image;
  std::vector<int> channels;
  try {
    image = ReadImage(texture.path);
    channels = ChannelsOf(image, texture.path);
  } catch (const InputError& error) {
    throw InputError(texture.where, "texture {}: {}", Quoted(texture.name),
                     WithoutPrefix(error));
  }
  ReplaceNotFinite(&image);
  Texels& texels = images_[index];
  texels.width = image.width, texels.height = image.height;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double sum = 0;
      for (int c : channels) {
        const std::size_t at = image.Offset(x, y, c);
        sum += image.is_bytes() ? Decoded(texture, image.bytes[at]) : image.pixels[at];
      }
      texels.values.push_back(
          static_cast<float>(sum / static_cast<double>(channels.size())));
    }
  }
}

double HeightTexture::ImageValue(const Texture& texture, const Texels& texels, double s,
                                 double t) const {
  const double shift = texture.bilinear ? 0.5 : 0;
  const double x = s * texels.width - shift, y = (1 - t) * texels.height - shift;
  const double fx = texture.bilinear ? x - std::floor(x) : 0;
  const double fy = texture.bilinear ? y - std::floor(y) : 0;
  double sum = 0;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const double weight = (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy);
      const int i = Wrapped(texture.wrap, std::floor(x) + dx, texels.width);
      const int j = Wrapped(texture.wrap, std::floor(y) + dy, texels.height);
      if (weight == 0 || i < 0 || j < 0) continue;
      const std::size_t at = static_cast<std::size_t>(j) * texels.width + i;
      sum += weight * texels.values[at];
    }
  }
  sum *= texture.scale;
  return std::max(texture.invert ? 1 - sum : sum, 0.0);
}

double HeightTexture::Value(Index index, double u, double v) const {
  const Texture& texture = textures_[static_cast<std::size_t>(index)];
  const auto color = [&](const ColorValue& c) {
    return c.texture == kNone ? c.constant.x : Value(c.texture, u, v);
  };
  const auto amount = [&] {
    return texture.amount.texture == kNone ? texture.amount.constant
                                           : Value(texture.amount.texture, u, v);
  };
  const double s = u * texture.mapping.su + texture.mapping.du;
  const double t = v * texture.mapping.sv + texture.mapping.dv;
  switch (texture.kind) {
    case TextureKind::kScale:
      return color(texture.tex1) * amount();
    case TextureKind::kMix:
      return color(texture.tex1) * (1 - amount()) + color(texture.tex2) * amount();
    case TextureKind::kCheckerboard: {
      const bool is_even = std::fmod(std::floor(s) + std::floor(t), 2) == 0;
      return color(is_even ? texture.tex1 : texture.tex2);
    }
    case TextureKind::kImage:
      return ImageValue(texture, images_.at(index), s, t);
    default:
      return texture.value.x;  // kConstant: Problem() lets no other pass
  }
}

}  // namespace lanelight
