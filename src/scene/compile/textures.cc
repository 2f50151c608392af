#include "src/scene/compile/textures.h"

#include "src/base/core/check.h"

namespace lanelight {
namespace {

// Marks what texture i refers to.
void MarkOperands(const std::vector<Texture>& textures, std::size_t i,
                  std::vector<bool>& used) {
  const Texture& t = textures[i];
  for (Index operand : {t.tex1.texture, t.tex2.texture, t.amount.texture}) {
    if (operand == kNone) continue;
    LL_CHECK_GE(operand, 0);
    LL_CHECK_LT(static_cast<std::size_t>(operand), i);
    used[static_cast<std::size_t>(operand)] = true;
  }
}

}  // namespace

TextureConstants::TextureConstants(const std::vector<Texture>& textures) {
  constants_.reserve(textures.size());
  for (const Texture& texture : textures) constants_.push_back(ConstantOf(texture));
}

std::optional<Rgb> TextureConstants::ConstantOf(const Texture& t) const {
  switch (t.kind) {
    case TextureKind::kConstant:
      return t.value;
    case TextureKind::kScale: {
      const auto a = ValueOf(t.tex1);
      const auto s = ValueOf(t.amount);
      if (a && s) return *a * *s;
      return std::nullopt;
    }
    case TextureKind::kMix: {
      const auto a = ValueOf(t.tex1), b = ValueOf(t.tex2);
      const auto w = ValueOf(t.amount);
      if (a && b && w) return *a * (1 - *w) + *b * *w;
      return std::nullopt;
    }
    default:
      return std::nullopt;  // depends on the point
  }
  return std::nullopt;
}

std::optional<Rgb> TextureConstants::ValueOf(const ColorValue& v) const {
  return v.texture == kNone ? v.constant : Of(v.texture);
}

std::optional<double> TextureConstants::ValueOf(const FloatValue& v) const {
  if (v.texture == kNone) return v.constant;
  const std::optional<Rgb>& c = Of(v.texture);
  return c ? std::optional<double>(c->x) : std::nullopt;
}

ColorValue TextureConstants::Fold(const ColorValue& value) const {
  if (value.texture == kNone) return value;  // with its spectrum
  const std::optional<Rgb> c = ValueOf(value);
  return c ? ColorValue{*c, kNone} : value;
}

FloatValue TextureConstants::Fold(const FloatValue& value) const {
  const std::optional<double> c = ValueOf(value);
  return c ? FloatValue{*c, kNone} : value;
}

std::vector<Texture> KeepUsedTextures(const std::vector<Texture>& textures,
                                      const std::vector<Index>& used) {
  std::vector<bool> keep(textures.size(), false);
  for (Index i : used) {
    LL_CHECK_GE(i, 0);
    keep.at(static_cast<std::size_t>(i)) = true;
  }
  // Operands are earlier, so what needs a texture has been seen before it.
  std::vector<Texture> kept = textures;
  for (std::size_t i = kept.size(); i-- > 0;) {
    if (keep[i]) {
      MarkOperands(textures, i, keep);
      continue;
    }
    Texture unused;
    unused.name = kept[i].name;
    unused.where = kept[i].where;
    unused.is_float = kept[i].is_float;
    kept[i] = unused;
  }
  return kept;
}

}  // namespace lanelight
