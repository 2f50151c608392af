// Textures at surface coordinates. The lanes of a vector may need different textures:
// each distinct one is evaluated for the whole vector, under a mask, so that its program
// runs without a branch per lane. Indices are clamped to the image whatever uv are, NaN
// and infinity included.
#ifndef LANELIGHT_TEXTURE_TEXTURE_INL_H_
#define LANELIGHT_TEXTURE_TEXTURE_INL_H_

#include "kernels/texture/coated_base-inl.h"
#include "kernels/texture/patterns-inl.h"

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

/// Alpha of a roughness, or of its root, as Integrator::regularize has it.
LANELIGHT_INLINE VF RegularAlpha(VF roughness, bool remap) {
  const VF clamped = hn::Max(roughness, Splat(0.0f));
  const VF alpha = remap ? hn::Sqrt(clamped) : clamped;
  const VF rougher = hn::Clamp(hn::Add(alpha, alpha), Splat(0.1f), Splat(0.3f));
  return hn::IfThenElse(hn::Lt(alpha, Splat(0.3f)), rougher, alpha);
}

/// Value of one texture at a point in every lane, filtered where that has a footprint
/// (levels-inl.h). Errors against real arithmetic come from rounding s = u * su + du to
/// float: up to |s| * 6e-8 of a repeat, times the slope.
template <class Point>
inline HWY_NOINLINE V3 EvalTexture(const TextureTable& table, int32_t texture,
                                   const Point& at) {
  const TextureProgram program = table.programs[texture];
  V3 value[kMaxTextureNodes];
  for (int32_t i = 0; i < program.count; ++i) {
    const TextureNode& node = table.nodes[program.begin + i];
    const auto operand = [&](int slot) HWY_ATTR -> V3 {
      const float* c = node.constant[slot];
      return node.operand[slot] >= 0 ? value[node.operand[slot]]
                                     : Splat3(c[0], c[1], c[2]);
    };
    const TexturePair st = MapPoint(node, at);
    switch (node.kind) {
      case TextureKind::kConstant:
        value[i] = operand(0);
        break;
      case TextureKind::kScale:
        value[i] = Mul(operand(0), operand(2).x);
        break;
      case TextureKind::kMix:
        value[i] = Lerp(operand(0), operand(1), operand(2).x);
        break;
      case TextureKind::kCheckerboard: {
        if constexpr (Point::kHasFootprint) {
          if (node.filter >= ImageFilter::kTrilinear) {
            const VF second = SecondOfChecks(st, StepsOf(node, at));
            value[i] = Lerp(operand(0), operand(1), second);
            break;
          }
        }
        MF even = EvenCell(st.s, st.t);
        if constexpr (Point::kHasPlace) {
          if (node.solid) even = EvenCell(PlaceOf(node, at.p));
        }
        value[i] = IfThenElse(even, operand(0), operand(1));
        break;
      }
      case TextureKind::kImage:
        if constexpr (Point::kHasFootprint) {
          if (node.filter >= ImageFilter::kTrilinear) {
            value[i] = EvalFiltered(table, node, st.s, st.t, StepsOf(node, at));
            break;
          }
        }
        value[i] = EvalImage(table, node, st.s, st.t);
        break;
      case TextureKind::kDots:
        // pbrt-v4 shows its parameter "inside" outside of the dots, and the reverse.
        value[i] = IfThenElse(InsideDot(st.s, st.t), operand(1), operand(0));
        break;
      case TextureKind::kBilinear:
        value[i] = Lerp(Lerp(operand(0), operand(1), st.t),
                        Lerp(operand(2), operand(3), st.t), st.s);
        break;
      case TextureKind::kMetalExtinction:
        value[i] = Mul(MetalExtinction(operand(0)), operand(2).x);
        break;
      case TextureKind::kCoatedBase:
        value[i] = CoatedBaseColor(table.fits.data() + node.fit, operand(0));
        break;
      case TextureKind::kRegularAlpha: {
        const VF alpha = RegularAlpha(operand(0).x, node.constant[2][0] != 0);
        value[i] = {alpha, alpha, alpha};
        break;
      }
      case TextureKind::kDirectionMix:
        if constexpr (Point::kHasPlace) {
          const float* d = node.place[0];
          const VF facing = hn::Abs(Dot(at.n, Splat3(d[0], d[1], d[2])));
          value[i] = Lerp(operand(1), operand(0), facing);
        }
        break;
      case TextureKind::kFbm:
      case TextureKind::kWrinkled:
      case TextureKind::kWindy:
      case TextureKind::kMarble:
        if constexpr (Point::kHasPlace) value[i] = EvalPattern(node, at.p);
        break;
    }
  }
  return value[program.count - 1];
}

/// Values of the lanes' own textures; lanes whose id is negative keep `constant`.
template <class Point>
LANELIGHT_INLINE V3 EvalTextures(const TextureTable& table, VI ids, const Point& at,
                                 V3 constant) {
  const DI di;
  auto pending = hn::Gt(ids, hn::Set(di, -1));
  while (!hn::AllFalse(di, pending)) {
    const int32_t id = hn::ExtractLane(ids, hn::FindFirstTrue(di, pending));
    const auto same = hn::Eq(ids, hn::Set(di, id));
    const MF mine = hn::RebindMask(DF(), same);
    // The other lanes read one texel, because theirs would not be used.
    const V3 value = EvalTexture(table, id, at.Only(mine));
    constant = IfThenElse(mine, value, constant);
    pending = hn::AndNot(same, pending);
  }
  return constant;
}

/// Value of the lanes' float textures, where their id is not negative, else `constant`.
template <class Point>
LANELIGHT_INLINE VF EvalFloats(const TextureTable& table, VI ids, const Point& at,
                               VF constant) {
  return EvalTextures(table, ids, at, {constant, constant, constant}).x;
}

/// Alpha of a single hit, for kernels that hold one ray.
LANELIGHT_INLINE float EvalAlphaAt(const TextureTable& table, int32_t id, float u,
                                   float v, float constant) {
  if (id < 0) return constant;
  return hn::GetLane(EvalTexture(table, id, UvPoint{Splat(u), Splat(v)}).x);
}

LANELIGHT_END_KERNELS

#endif
