// Float textures for tests.
#pragma once

#include <string>

#include "src/scene/description/description.h"

namespace lanelight {

inline Texture FloatTexture(TextureKind kind) {
  Texture t;
  t.kind = kind;
  t.name = "height";
  t.is_float = true;
  return t;
}

inline Texture Constant(double value) {
  Texture t = FloatTexture(TextureKind::kConstant);
  t.value = {value, value, value};
  return t;
}

inline Texture FromFile(const std::string& path, WrapMode wrap, bool bilinear) {
  Texture t = FloatTexture(TextureKind::kImage);
  t.path = path;
  t.wrap = wrap;
  t.bilinear = bilinear;
  t.encoding = Encoding::kLinear;
  t.mapping = {1.7, -2.3, 0.2, 0.4};
  return t;
}

}  // namespace lanelight
