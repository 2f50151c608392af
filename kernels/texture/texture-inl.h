// Textures at surface coordinates. The lanes of a vector may need different textures:
// each distinct one is evaluated for the whole vector, under a mask, so that its program
// runs without a branch per lane.
#ifndef LANELIGHT_TEXTURE_TEXTURE_INL_H_
#define LANELIGHT_TEXTURE_TEXTURE_INL_H_

#include "kernels/texture/coated_base-inl.h"
#include "kernels/texture/levels-inl.h"
#include "kernels/texture/patterns-inl.h"

LANELIGHT_BEGIN_KERNELS

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
