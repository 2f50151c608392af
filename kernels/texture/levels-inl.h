// Filters images by their pyramids over the footprint of a pixel. `trilinear` (Williams
// 1983, "Pyramidal Parametrics") takes the level at which the longer side of the
// footprint, twice, is a texel, and its neighbour. `ewa` takes the level of the shorter
// axis and averages along the longer one in steps of the shorter. It uses the Gaussian
// weights of Heckbert's ellipse (McCormack, Perry, Farkas and Jouppi 1999, "Feline: Fast
// Elliptical Lines for Anisotropic Texture Mapping"). `maxanisotropy` bounds the ratio of
// the axes.
#ifndef LANELIGHT_TEXTURE_LEVELS_INL_H_
#define LANELIGHT_TEXTURE_LEVELS_INL_H_

#include "hwy/contrib/math/math-inl.h"
#include "kernels/queue/slots-inl.h"
#include "kernels/texture/image-inl.h"
#include "kernels/texture/mapping-inl.h"
#include "src/vocabulary/path/fields.h"

LANELIGHT_BEGIN_KERNELS

LANELIGHT_INLINE Footprint LoadFootprint(const PathColumns& path, const Slots& slots) {
  return {Gather(path.footprint_0, slots), Gather(path.footprint_1, slots),
          Gather(path.footprint_2, slots), Gather(path.footprint_3, slots)};
}

/// Bilinear lookup in the lanes' own levels.
LANELIGHT_INLINE V3 EvalLevel(const TextureTable& table, const TextureNode& node,
                              VI level, VF s, VF t) {
  const DF df;
  const TextureImage& image = table.images[node.image];
  const VI w = Lookup(image.level_width, level), h = Lookup(image.level_height, level);
  const VI begin = Lookup(image.level_begin, level);
  const TexelPair x = FindTexels(s, false, hn::ConvertTo(df, w), node);
  const TexelPair y = FindTexels(t, true, hn::ConvertTo(df, h), node);
  const auto texel = [&](VI i, VI j) HWY_ATTR {
    MF inside = hn::FirstN(df, hn::Lanes(df));
    const VI index = hn::Add(begin, WrappedIndex(w, h, node.wrap, i, j, inside));
    return IfThenElseZero(inside, LoadTexels(table, image, index));
  };
  const V3 top = Lerp(texel(x.i0, y.i0), texel(x.i1, y.i0), x.weight);
  const V3 bottom = Lerp(texel(x.i0, y.i1), texel(x.i1, y.i1), x.weight);
  return Lerp(top, bottom, y.weight);
}

/// Between the two levels around that in which a texel is `width` texels of the image.
LANELIGHT_INLINE V3 EvalTrilinear(const TextureTable& table, const TextureNode& node,
                                  VF width, VF s, VF t) {
  const DF df;
  const DI di;
  const auto last = static_cast<int32_t>(table.images[node.image].level_begin.size()) - 1;
  const VF level =
      hn::Min(hn::Log2(df, hn::Max(width, Splat(1.0f))), Splat(static_cast<float>(last)));
  const VF low = hn::Floor(level), weight = hn::Sub(level, low);
  const VI index = hn::ConvertTo(di, low);
  const V3 color = EvalLevel(table, node, index, s, t);
  if (hn::AllTrue(df, hn::Eq(weight, hn::Zero(df)))) return color;
  const VI next = hn::Min(hn::Add(index, hn::Set(di, 1)), hn::Set(di, last));
  return Lerp(color, EvalLevel(table, node, next, s, t), weight);
}

// `d`: steps in texels of the image.
LANELIGHT_INLINE V3 EvalAlongLine(const TextureTable& table, const TextureNode& node,
                                  const MapSteps& d, VF s, VF t) {
  const DF df;
  const TextureImage& image = table.images[node.image];
  const VF one = Splat(1.0f), two = Splat(2.0f);
  const VF x = hn::Sqrt(hn::MulAdd(d.s_x, d.s_x, hn::Mul(d.t_x, d.t_x)));
  const VF y = hn::Sqrt(hn::MulAdd(d.s_y, d.s_y, hn::Mul(d.t_y, d.t_y)));
  const MF along_x = hn::Ge(x, y);
  const VF longer = hn::Max(hn::Max(x, y), Splat(1e-20f));
  const VF shorter =
      hn::Max(hn::Min(x, y), hn::Mul(longer, Splat(1 / node.max_anisotropy)));
  // A texel is the least that a step must cover.
  const VF count = hn::Min(hn::Ceil(hn::Div(longer, hn::Max(shorter, one))),
                           Splat(std::ceil(node.max_anisotropy)));
  const VF steps = hn::Max(count, one);
  const VF ds = hn::Mul(hn::IfThenElse(along_x, d.s_x, d.s_y),
                        Splat(1.0f / static_cast<float>(image.width)));
  const VF dt = hn::Mul(hn::IfThenElse(along_x, d.t_x, d.t_y),
                        Splat(1.0f / static_cast<float>(image.height)));
  const float maximum = hn::GetLane(hn::MaxOfLanes(df, steps));
  V3 sum = Splat3(0, 0, 0);
  VF weights = hn::Zero(df);
  for (float k = 0; k < maximum; ++k) {
    const VF at = hn::Sub(hn::Div(Splat(2 * k + 1), steps), one);  // -1 .. 1
    const VF bell = hn::Sub(hn::Exp(df, hn::Neg(hn::Mul(two, hn::Mul(at, at)))),
                            Splat(0.13533528f));  // exp(-2)
    const VF weight = hn::IfThenElseZero(hn::Lt(Splat(k), steps), bell);
    const V3 color =
        EvalTrilinear(table, node, shorter, hn::MulAdd(ds, at, s), hn::MulAdd(dt, at, t));
    sum = MulAdd(color, weight, sum);
    weights = hn::Add(weights, weight);
  }
  return Mul(sum, hn::Div(one, weights));
}

/// The image of a node that has levels, at (s, t), over a footprint.
inline HWY_NOINLINE V3 EvalFiltered(const TextureTable& table, const TextureNode& node,
                                    VF s, VF t, const MapSteps& f) {
  const TextureImage& image = table.images[node.image];
  const VF w = Splat(static_cast<float>(image.width));
  const VF h = Splat(static_cast<float>(image.height));
  const MapSteps d = {hn::Mul(f.s_x, w), hn::Mul(f.t_x, h), hn::Mul(f.s_y, w),
                      hn::Mul(f.t_y, h)};
  if (node.filter == ImageFilter::kEwa) {
    return FinishTexel(node, EvalAlongLine(table, node, d, s, t));
  }
  const VF longest = hn::Max(hn::Max(hn::Abs(d.s_x), hn::Abs(d.t_x)),
                             hn::Max(hn::Abs(d.s_y), hn::Abs(d.t_y)));
  const VF width = hn::Add(longest, longest);
  return FinishTexel(node, EvalTrilinear(table, node, width, s, t));
}

LANELIGHT_END_KERNELS

#endif
