// Textures as the kernels read them. A texture is a short program: its nodes in an order
// in which operands come first. Evaluation is a loop without recursion, and a shared node
// costs once. Constant children are folded into their parents.
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/core/aligned.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {

/// Nodes that one texture may have after constants are folded; more is an InputError.
inline constexpr int kMaxTextureNodes = 32;

/// 8-bit images keep their bytes: one 32-bit word per texel, R in the low byte, and a
/// decode table of 256 entries; float images have three floats per texel. Row 0 is the
/// top. Images of float textures hold the one value of a texel three times.
///
/// A pyramid follows the image itself in the same array where a texture asks for one
/// (src/scene/compile/texture_programs.h).
struct TextureImage {
  std::int32_t width = 0, height = 0;
  AlignedVector<std::uint32_t> rgba8;  // width * height, or empty
  AlignedVector<float> rgb;            // 3 * width * height, or empty
  std::int32_t decode = 0;             // offset into TextureTable::decode (8-bit images)
  // Per level of the pyramid, the image itself first: size, and its first texel. Empty
  // without one.
  AlignedVector<std::int32_t> level_width, level_height, level_begin;
};

/// One node. An operand >= 0 is the value of that earlier node of the same program;
/// -1 is the constant beside it.
struct TextureNode {
  TextureKind kind = TextureKind::kConstant;
  std::int32_t operand[4] = {-1, -1, -1, -1};  // tex1, tex2, amount; or four corners
  float constant[4][3] = {};             // of tex1 (kConstant: the value), tex2, amount
  float su = 1, sv = 1, du = 0, dv = 0;  // uv mapping
  MappingKind mapping = MappingKind::kUv;
  float place[3][4] = {};  // rows times (p, 1), p of the scene: where a pattern is looked
                           // up, or a mapping begins; kDirectionMix: row 0 times normal
  std::int32_t octaves = 0;            // kFbm, kWrinkled, kMarble
  float roughness = 0, variation = 0;  // the same; kMarble
  bool solid = false;                  // kCheckerboard: of three dimensions
  std::int32_t fit = -1;               // kCoatedBase: offset into TextureTable::fits
  std::int32_t image = -1;             // kImage: index into TextureTable::images
  WrapMode wrap = WrapMode::kRepeat;
  bool bilinear = true;
  // kImage: with kTrilinear and kEwa it has levels. kCheckerboard: these filter it.
  ImageFilter filter = ImageFilter::kBilinear;
  float max_anisotropy = 8;  // kEwa
  bool invert = false;       // max(0, 1 - scale * texel)
  float scale = 1;
};

/// The nodes [begin, begin + count) of TextureTable::nodes; the last one is the result.
struct TextureProgram {
  std::int32_t begin = 0, count = 0;
  bool uses_place = false;  // depends on the place or the normal, not on (u, v) alone
};

struct TextureTable {
  std::vector<TextureProgram> programs;  // one per texture of the description
  std::vector<TextureNode> nodes;
  std::vector<TextureImage> images;  // each file once per use
  AlignedVector<float> decode;       // 256 linear values per encoding in use
  AlignedVector<float> fits;         // src/scene/compile/coat.h
  std::size_t size() const { return programs.size(); }
};

/// Per primitive, only with kAlpha: texture of the alpha cut-out or -1, and constant.
struct AlphaTable {
  AlignedVector<std::int32_t> texture;
  AlignedVector<float> constant;
};

}  // namespace lanelight
