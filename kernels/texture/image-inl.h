// Looks up texels of images. Indices are clamped to the image whatever uv are, NaN and
// infinity included.
#ifndef LANELIGHT_TEXTURE_IMAGE_INL_H_
#define LANELIGHT_TEXTURE_IMAGE_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

/// Two neighbouring texels along one axis: indices before wrapping, weight of the second.
struct TexelPair {
  VI i0, i1;
  VF weight;
};

LANELIGHT_INLINE VF Fraction(VF x) { return hn::Sub(x, hn::Floor(x)); }

LANELIGHT_INLINE VI ClampIndex(VI i, VI size) {
  return hn::Min(hn::Max(i, hn::Zero(DI())), hn::Sub(size, hn::Set(DI(), 1)));
}

/// The texels around coordinate s of an axis with n texels, whose centres are at
/// (i + 0.5) / n; `flip` counts from the other end (1 - s). Nearest lookups have
/// weight 0 and use i0.
LANELIGHT_INLINE TexelPair FindTexels(VF s, bool flip, VF n, const TextureNode& node) {
  const VF one = Splat(1.0f);
  VF x;
  if (node.wrap == WrapMode::kRepeat) {
    // Flipping after the fraction is taken loses nothing when s is large.
    const VF f = Fraction(s);
    x = hn::Mul(flip ? hn::Sub(one, f) : f, n);  // [0, n]
  } else {
    if (flip) s = hn::Sub(one, s);
    // Keeps the conversion to integers in range; texels repeat far outside.
    const VF far = node.wrap == WrapMode::kOctahedralSphere ? n : Splat(2.0f);
    x = hn::Min(hn::Max(hn::Mul(s, n), hn::Neg(far)), hn::Add(n, far));
  }
  if (node.bilinear) x = hn::Sub(x, Splat(0.5f));
  const VF low = hn::Floor(x);
  // NaN has no integer; the weight keeps it, so that the result shows it.
  const VI i0 = hn::ConvertTo(DI(), hn::IfThenElseZero(hn::Eq(low, low), low));
  return {i0, hn::Add(i0, hn::Set(DI(), 1)),
          node.bilinear ? hn::Sub(x, low) : Splat(0.0f)};
}

/// Texel index of column i, row j of w x h after wrapping; clears `inside` where the wrap
/// mode makes the texel black. The octahedral map is folded once across each edge of the
/// square: it continues there with its own texels, turned about the middle of the edge.
/// As in pbrt-v4, texel -1 is texel 1, while n is n - 1.
LANELIGHT_INLINE VI WrappedIndex(VI w, VI h, WrapMode wrap, VI i, VI j, MF& inside) {
  const VI zero = hn::Zero(DI()), one = hn::Set(DI(), 1);
  if (wrap == WrapMode::kRepeat) {
    // i is in [-1, w]
    i = hn::IfThenElse(hn::Lt(i, zero), hn::Add(i, w), i);
    i = hn::IfThenElse(hn::Lt(i, w), i, hn::Sub(i, w));
    j = hn::IfThenElse(hn::Lt(j, zero), hn::Add(j, h), j);
    j = hn::IfThenElse(hn::Lt(j, h), j, hn::Sub(j, h));
  } else if (wrap == WrapMode::kBlack) {
    const auto in_columns = hn::AndNot(hn::Lt(i, zero), hn::Lt(i, w));
    const auto in_rows = hn::AndNot(hn::Lt(j, zero), hn::Lt(j, h));
    inside = hn::And(inside, hn::RebindMask(DF(), hn::And(in_columns, in_rows)));
  } else if (wrap == WrapMode::kOctahedralSphere) {
    const VI last_i = hn::Sub(w, one), last_j = hn::Sub(h, one);
    const auto fold = [&](VI& along, VI last, VI& across, VI last_across) HWY_ATTR {
      const auto above = hn::Gt(along, last);
      const auto outside = hn::Or(hn::Lt(along, zero), above);
      const VI from_last = hn::Sub(hn::Add(last, hn::Add(last, one)), along);
      along = hn::IfThenElse(above, from_last, hn::Abs(along));
      across = hn::IfThenElse(outside, hn::Sub(last_across, across), across);
    };
    fold(i, last_i, j, last_j);
    fold(j, last_j, i, last_i);
  }
  i = ClampIndex(i, w);
  j = ClampIndex(j, h);
  return hn::Add(hn::Mul(j, w), i);
}

/// Decoded colour of texels.
LANELIGHT_INLINE V3 LoadTexels(const TextureTable& table, const TextureImage& image,
                               VI index) {
  if (image.rgba8.empty()) {
    return Gather3(image.rgb.data(), index);
  }
  const float* decode = table.decode.data() + image.decode;
  const VI word = Gather(image.rgba8.data(), index);
  const VI byte = hn::Set(DI(), 255);
  return {Gather(decode, hn::And(word, byte)),
          Gather(decode, hn::And(hn::ShiftRight<8>(word), byte)),
          Gather(decode, hn::And(hn::ShiftRight<16>(word), byte))};
}

LANELIGHT_INLINE V3 Texel(const TextureTable& table, const TextureNode& node, VI i,
                          VI j) {
  const TextureImage& image = table.images[node.image];
  const VI w = hn::Set(DI(), image.width), h = hn::Set(DI(), image.height);
  MF inside = hn::FirstN(DF(), hn::Lanes(DF()));
  const V3 color = LoadTexels(table, image, WrappedIndex(w, h, node.wrap, i, j, inside));
  return node.wrap == WrapMode::kBlack ? IfThenElseZero(inside, color) : color;
}

/// a + (b - a) * t, exact at t = 0 and t = 1.
LANELIGHT_INLINE V3 Lerp(V3 a, V3 b, VF t) {
  return Mul(a, hn::Sub(Splat(1.0f), t)) + Mul(b, t);
}

/// Applies scale and inversion of a node to a texel, and clamps it at 0.
LANELIGHT_INLINE V3 FinishTexel(const TextureNode& node, V3 color) {
  color = Mul(color, Splat(node.scale));
  if (node.invert) color = Splat3(1, 1, 1) - color;
  const VF zero = Splat(0.0f);
  return {hn::Max(color.x, zero), hn::Max(color.y, zero), hn::Max(color.z, zero)};
}

LANELIGHT_INLINE V3 EvalImage(const TextureTable& table, const TextureNode& node, VF s,
                              VF t) {
  const TextureImage& image = table.images[node.image];
  const VF w = Splat(static_cast<float>(image.width));
  const VF h = Splat(static_cast<float>(image.height));
  const TexelPair x = FindTexels(s, false, w, node), y = FindTexels(t, true, h, node);
  V3 color = Texel(table, node, x.i0, y.i0);
  if (node.bilinear) {
    const V3 top = Lerp(color, Texel(table, node, x.i1, y.i0), x.weight);
    const V3 bottom =
        Lerp(Texel(table, node, x.i0, y.i1), Texel(table, node, x.i1, y.i1), x.weight);
    color = Lerp(top, bottom, y.weight);
  }
  return FinishTexel(node, color);
}

LANELIGHT_END_KERNELS

#endif
