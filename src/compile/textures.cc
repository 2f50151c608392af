#include "src/compile/textures.h"

#include "src/core/check.h"

namespace lanelight {
namespace {

const Texture& At(const std::vector<Texture>& textures, Index i) {
  LL_CHECK_GE(i, 0);
  LL_CHECK_LT(static_cast<std::size_t>(i), textures.size());
  return textures[static_cast<std::size_t>(i)];
}

std::optional<Rgb> Constant(const std::vector<Texture>& textures, const ColorValue& v) {
  return v.texture == kNone ? v.constant : ConstantTexture(textures, v.texture);
}

std::optional<double> Constant(const std::vector<Texture>& textures,
                               const FloatValue& v) {
  if (v.texture == kNone) return v.constant;
  const std::optional<Rgb> c = ConstantTexture(textures, v.texture);
  return c ? std::optional<double>(c->x) : std::nullopt;
}

void Mark(const std::vector<Texture>& textures, Index i, std::vector<bool>& used) {
  if (i == kNone) return;
  const Texture& t = At(textures, i);
  if (used[static_cast<std::size_t>(i)]) return;
  used[static_cast<std::size_t>(i)] = true;
  Mark(textures, t.tex1.texture, used);
  Mark(textures, t.tex2.texture, used);
  Mark(textures, t.amount.texture, used);
}

}  // namespace

std::optional<Rgb> ConstantTexture(const std::vector<Texture>& textures, Index texture) {
  const Texture& t = At(textures, texture);
  // A texture refers only to earlier ones, so this recursion ends.
  switch (t.kind) {
    case TextureKind::kConstant:
      return t.value;
    case TextureKind::kScale: {
      const auto a = Constant(textures, t.tex1);
      const auto s = Constant(textures, t.amount);
      if (a && s) return *a * *s;
      return std::nullopt;
    }
    case TextureKind::kMix: {
      const auto a = Constant(textures, t.tex1), b = Constant(textures, t.tex2);
      const auto w = Constant(textures, t.amount);
      if (a && b && w) return *a * (1 - *w) + *b * *w;
      return std::nullopt;
    }
    case TextureKind::kCheckerboard:
    case TextureKind::kImage:
      return std::nullopt;
  }
  return std::nullopt;
}

ColorValue FoldConstant(const std::vector<Texture>& textures, const ColorValue& value) {
  const std::optional<Rgb> c = Constant(textures, value);
  return c ? ColorValue{*c, kNone} : value;
}

FloatValue FoldConstant(const std::vector<Texture>& textures, const FloatValue& value) {
  const std::optional<double> c = Constant(textures, value);
  return c ? FloatValue{*c, kNone} : value;
}

std::vector<Texture> KeepUsedTextures(const std::vector<Texture>& textures,
                                      const std::vector<Index>& used) {
  std::vector<bool> keep(textures.size(), false);
  for (Index i : used) Mark(textures, i, keep);
  std::vector<Texture> kept = textures;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (keep[i]) continue;
    Texture unused;
    unused.name = kept[i].name;
    unused.where = kept[i].where;
    unused.is_float = kept[i].is_float;
    kept[i] = unused;
  }
  return kept;
}

}  // namespace lanelight
