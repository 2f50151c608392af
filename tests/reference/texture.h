// The scalar twin of kernels/texture: recursion, double precision, its own formulas.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "src/base/core/check.h"
#include "src/base/image/image.h"
#include "src/scene/description/description.h"
#include "tests/reference/geometry.h"
#include "tests/reference/pattern.h"

namespace lanelight::reference {

/// Textures of a description with their images.
class Textures {
 public:
  explicit Textures(const std::vector<Texture>& textures) : textures_(textures) {
    for (const Texture& t : textures) {
      if (t.kind == TextureKind::kImage && !images_.count(t.path)) {
        images_[t.path] = ReadImage(t.path);
      }
    }
  }

  /// Value of a texture at surface coordinates (u, v), if it does not depend on places.
  Rgb Eval(Index index, double u, double v) const { return Eval(index, {u, v, {}, {}}); }

  /// Value of a texture at a point.
  Rgb Eval(Index index, const TexturePoint& at) const {
    const Texture& t = textures_[index];
    const auto child = [&](const ColorValue& c) {
      return c.texture == kNone ? c.constant : Eval(c.texture, at);
    };
    const double amount =
        t.amount.texture == kNone ? t.amount.constant : Eval(t.amount.texture, at).x;
    const Vec3d q = t.texture_from_world.Point(at.p);
    const auto [s, v] = Coordinates(t, at, q);
    switch (t.kind) {
      case TextureKind::kConstant:
        return t.value;
      case TextureKind::kScale:
        return child(t.tex1) * amount;
      case TextureKind::kMix:
        return (1 - amount) * child(t.tex1) + amount * child(t.tex2);
      case TextureKind::kCheckerboard: {
        const double cells = t.dimension == 2
                                 ? std::floor(s) + std::floor(v)
                                 : std::floor(q.x) + std::floor(q.y) + std::floor(q.z);
        return child(std::fmod(std::abs(cells), 2) == 0 ? t.tex1 : t.tex2);
      }
      case TextureKind::kImage:
        return EvalImage(t, s, v);
      case TextureKind::kDirectionMix: {
        const double facing = std::abs(Dot(at.n, t.direction));
        return facing * child(t.tex1) + (1 - facing) * child(t.tex2);
      }
      case TextureKind::kDots:  // pbrt's "inside" is what the dots lie on
        return child(IsInDot(s, v) ? t.tex2 : t.tex1);
      case TextureKind::kBilinear:
        return (1 - s) * (1 - v) * t.corners[0].constant +
               (1 - s) * v * t.corners[1].constant + s * (1 - v) * t.corners[2].constant +
               s * v * t.corners[3].constant;
      case TextureKind::kFbm:
        return Rgb{1, 1, 1} * Fbm(q, t.octaves, t.roughness);
      case TextureKind::kWrinkled:
        return Rgb{1, 1, 1} * Wrinkled(q, t.octaves, t.roughness);
      case TextureKind::kWindy:
        return Rgb{1, 1, 1} * Windy(q);
      case TextureKind::kMarble:
        return MarbleColor(t.noise_scale * q, t.octaves, t.roughness, t.variation);
      case TextureKind::kMetalExtinction:
      case TextureKind::kCoatedBase:
      case TextureKind::kRegularAlpha:
        break;  // of compiled scenes alone
    }
    LL_CHECK(!"a texture of this kind is in no file");
    return {};
  }

  /// Of an image: width and height, and the width of a square one.
  std::pair<int, int> Resolution(Index index) const {
    const Image& image = images_.at(textures_[index].path);
    return {image.width, image.height};
  }
  int Size(Index index) const { return Resolution(index).first; }

 private:
  // The coordinates that a mapping gives; q: the point in the space of the texture.
  static std::array<double, 2> Coordinates(const Texture& t, const TexturePoint& at,
                                           Vec3d q) {
    const UvMapping& m = t.mapping;
    constexpr double kTurn = 2 * std::numbers::pi;
    double turns = std::atan2(q.y, q.x) / kTurn;
    switch (m.kind) {
      case MappingKind::kUv:
        return {m.su * at.u + m.du, m.sv * at.v + m.dv};
      case MappingKind::kSpherical:
        return {std::acos(q.z / Length(q)) / std::numbers::pi,
                turns < 0 ? turns + 1 : turns};
      case MappingKind::kCylindrical:
        return {turns + 0.5, q.z};
      case MappingKind::kPlanar:
        return {Dot(q, m.v1) + m.du, Dot(q, m.v2) + m.dv};
    }
    return {};
  }

  // The image is a grid of samples at texel centres; row 0 is at the top, where v = 1.
  Rgb EvalImage(const Texture& t, double s, double v) const {
    const Image& image = images_.at(t.path);
    const double x = s * image.width, y = (1 - v) * image.height;
    Rgb sum;
    if (t.bilinear) {
      // Tent weights of the four nearest centres.
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          const double cx = std::floor(x - 0.5) + dx, cy = std::floor(y - 0.5) + dy;
          const double weight =
              (1 - std::abs(x - (cx + 0.5))) * (1 - std::abs(y - (cy + 0.5)));
          sum += weight * Sample(t, image, cx, cy);
        }
      }
    } else {
      sum = Sample(t, image, std::floor(x), std::floor(y));
    }
    for (int c = 0; c < 3; ++c) {
      sum[c] *= t.scale;
      if (t.invert) sum[c] = 1 - sum[c];
      if (sum[c] < 0) sum[c] = 0;
    }
    return sum;
  }

  static double Modulo(double a, double n) { return a - n * std::floor(a / n); }

  // The sample in column cx, row cy of the plane tiled, extended or mirrored with the
  // image.
  Rgb Sample(const Texture& t, const Image& image, double cx, double cy) const {
    const double w = image.width, h = image.height;
    switch (t.wrap) {
      case WrapMode::kRepeat:
        cx = Modulo(cx, w), cy = Modulo(cy, h);
        break;
      case WrapMode::kClamp:
        break;
      case WrapMode::kBlack:
        if (cx < 0 || cx >= w || cy < 0 || cy >= h) return {};
        break;
      case WrapMode::kOctahedralSphere:
        // Crossing an edge leads back in at the mirror image of the crossing point; below
        // 0 pbrt leaves out the first sample.
        if (cx < 0 || cx >= w) cx = cx < 0 ? -cx : 2 * w - 1 - cx, cy = h - 1 - cy;
        if (cy < 0 || cy >= h) cy = cy < 0 ? -cy : 2 * h - 1 - cy, cx = w - 1 - cx;
        break;
    }
    const int i = static_cast<int>(std::min(std::max(cx, 0.0), w - 1));
    const int j = static_cast<int>(std::min(std::max(cy, 0.0), h - 1));
    return Pixel(t, image, i, j);
  }

  double Channel(const Texture& t, const Image& image, int i, int j, int c) const {
    if (!image.is_bytes()) return image.At(i, j, c);
    const double e = image.bytes[image.Offset(i, j, c)] / 255.0;
    if (t.encoding == Encoding::kLinear) return e;
    if (t.encoding == Encoding::kGamma) return std::pow(e, t.gamma);
    return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
  }

  Rgb Pixel(const Texture& t, const Image& image, int i, int j) const {
    const auto channel = [&](int c) { return Channel(t, image, i, j, c); };
    if (image.channels < 3) return Rgb{1, 1, 1} * channel(0);
    const Rgb rgb{channel(0), channel(1), channel(2)};
    if (!t.is_float) return rgb;
    bool has_alpha = false;
    for (int y = 0; image.channels == 4 && y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        has_alpha |= image.is_bytes() ? image.bytes[image.Offset(x, y, 3)] != 255
                                      : image.At(x, y, 3) != 1;
      }
    }
    return Rgb{1, 1, 1} * (has_alpha ? channel(3) : (rgb.x + rgb.y + rgb.z) / 3);
  }

  const std::vector<Texture>& textures_;
  std::map<std::string, Image> images_;
};

/// Value of a normal map at (u, v), as it is in the file; loads it each time.
inline Rgb NormalMap(const std::string& path, double u, double v) {
  Texture image;
  image.kind = TextureKind::kImage;
  image.path = path;
  image.encoding = Encoding::kLinear;
  const std::vector<Texture> textures = {image};
  return Textures(textures).Eval(0, u, v);
}

/// Value of texture `index` at (u, v); loads the images each time.
inline Rgb EvalTexture(const std::vector<Texture>& textures, Index index, double u,
                       double v) {
  return Textures(textures).Eval(index, u, v);
}

}  // namespace lanelight::reference
