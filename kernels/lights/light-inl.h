// Shared by the light kernels: records, the loop over one shape of light, the columns of
// a light sample.
#ifndef LANELIGHT_LIGHTS_LIGHT_INL_H_
#define LANELIGHT_LIGHTS_LIGHT_INL_H_

#include <cstddef>

#include "kernels/directions/heuristic-inl.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/simd/records-inl.h"
#include "kernels/texture/wavelengths-inl.h"
#include "src/scene/compiled/lights.h"
#include "src/scene/prepare/tables.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

/// The lights of a vector of lanes.
struct Lights : RecordWords<LightRecord> {
  LANELIGHT_INLINE Lights(const SceneParts& scene, VI light)
      : RecordWords(scene.lights->lights.data(), light) {}
  LANELIGHT_INLINE V3 Radiance() const { return F3(offsetof(LightRecord, radiance)); }
  LANELIGHT_INLINE VF Area() const { return F(offsetof(LightRecord, area)); }
  LANELIGHT_INLINE VI Primitive() const { return I(offsetof(LightRecord, primitive)); }
  /// Spheres: squared distance beyond which they are sampled by their cone of directions,
  /// that is, from outside; else by area.
  LANELIGHT_INLINE VF ConeFrom() const { return F(offsetof(LightRecord, size)); }
  LANELIGHT_INLINE MF TwoSided() const { return IsSet(offsetof(LightRecord, two_sided)); }
};

/// Returns the probabilities with which light-selection=learned has selected, or would
/// have selected, lights at the last vertices.
LANELIGHT_INLINE VF LearnedPmf(const Wave& wave, const Slots& slots, VI light) {
  const LearnedLights& learned = wave.run->tables->lights;
  const VI groups = hn::Set(DI(), static_cast<int32_t>(learned.num_groups));
  const VI first = hn::Mul(Gather(wave.path.light_row, slots), groups);
  const VI entry = hn::Add(first, Gather(learned.group.data(), light));
  return hn::Mul(Gather(learned.pmf.data(), entry), Gather(learned.within.data(), light));
}

/// Returns the probabilities of selecting lights. Those of a light tree and of what has
/// been learned depend on the place.
LANELIGHT_INLINE VF Pmf(const Wave& wave, const Slots& slots, VI light) {
  if (wave.path.light_pmf != nullptr) return Gather(wave.path.light_pmf, slots);
  if (wave.path.light_row != nullptr) return LearnedPmf(wave, slots, light);
  return Gather(wave.chances->pmf.data(), light);
}

/// Returns whether the probabilities are those of LightChances everywhere.
LANELIGHT_INLINE bool IsPmfConstant(const Wave& wave) {
  return wave.path.light_pmf == nullptr && wave.path.light_row == nullptr;
}

/// Primitive ids that may emit: most hits need no look at their record.
struct PrimitiveSpan {
  uint32_t first = 0, last = 0x7fffffffu;
};
LANELIGHT_INLINE PrimitiveSpan EmittingSpan(const LightTable& table) {
  // Looking through many lights would cost more than it saves.
  if (table.lights.size() > 64) return {};
  PrimitiveSpan span = {0x7fffffffu, 0};
  for (const LightRecord& light : table.lights) {
    if (light.primitive == 0xffffffffu) continue;
    span.first = HWY_MIN(span.first, light.primitive);
    span.last = HWY_MAX(span.last, light.primitive);
    if (light.shape != static_cast<uint32_t>(LightShape::kRectangle)) continue;
    span.first = HWY_MIN(span.first, light.second_primitive);
    span.last = HWY_MAX(span.last, light.second_primitive);
  }
  return span;
}

/// Calls body(slots, light) for the paths of kLit whose selected light has this shape.
/// With a single light there is nothing to select and nothing to filter.
template <bool kMany, class Body>
LANELIGHT_INLINE void ForEachLit(Wave& wave, LightShape shape, Body&& body) {
  if constexpr (!kMany) {
    ForEachBatch(wave, wave.queue(QueueId::kLit),
                 [&](const StoreSlots& slots, MF)
                     HWY_ATTR { body(slots, hn::Zero(DI())); });
  } else {
    const uint32_t* selected = wave.path.ls_light;
    const VI wanted = hn::Set(DI(), static_cast<int32_t>(shape));
    const Queue& mine =
        FilterQueue(wave, wave.queue(QueueId::kLit), [&](const Slots& slots) HWY_ATTR {
          const Lights light(wave, Gather(selected, slots));
          return hn::RebindMask(DF(),
                                hn::Eq(light.I(offsetof(LightRecord, shape)), wanted));
        });
    ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
      body(slots, Gather(selected, slots));
    });
  }
}

/// A light sample; it carries no light if it is not usable.
struct LightSample {
  V3 direction;
  VF distance;
  V3 radiance_over_pdf;
  VF pdf_sa;
  MF usable;
};

LANELIGHT_INLINE void StoreLightSample(const PathColumns& p, const StoreSlots& slots,
                                       const LightSample& s) {
  Scatter3(s.direction, p.ls_x, p.ls_y, p.ls_z, slots);
  Scatter(s.distance, p.ls_distance, slots);
  Scatter3(IfThenElseZero(s.usable, s.radiance_over_pdf), p.ls_r, p.ls_g, p.ls_b, slots);
  Scatter(s.pdf_sa, p.ls_pdf, slots);
}

/// Returns the distance of a hit from the point at which its ray was scattered;
/// interfaces of media may lie between.
LANELIGHT_INLINE VF HitDistance(const PathColumns& p, const Slots& slots) {
  const VF t = Gather(p.t, slots);
  return p.passed == nullptr ? t : hn::Add(t, Gather(p.passed, slots));
}

/// Returns the point at which the path's ray was scattered.
LANELIGHT_INLINE V3 ScatteredFrom(const PathColumns& p, const Slots& slots) {
  const V3 o = Gather3(p.o_x, p.o_y, p.o_z, slots);
  if (p.passed == nullptr) return o;
  const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
  return MulAdd(d, hn::Neg(Gather(p.passed, slots)), o);
}

LANELIGHT_INLINE VF SumAbs(V3 v) {
  return hn::Add(hn::Abs(v.x), hn::Add(hn::Abs(v.y), hn::Abs(v.z)));
}

/// Returns how far in front of the surface at q a ray from `from` ends. Rounding of the
/// points and of the ray then cannot make it meet that surface.
LANELIGHT_INLINE VF Clearance(V3 from, V3 q, VF p_error) {
  return hn::MulAdd(Splat(1e-6f), hn::Add(SumAbs(from), SumAbs(q)),
                    hn::Mul(Splat(2.0f), p_error));
}

/// The shadow ray to point q with unit normal n of a surface light. The light must not
/// shadow itself: the ray ends in front of it, by a bound on the rounding of both end
/// points (about 8 ulp) and on the offset of its origin.
struct ShadowRay {
  V3 direction;
  VF distance2, distance, cos_light;

  LANELIGHT_INLINE ShadowRay(const PathColumns& p, const StoreSlots& slots, V3 q, V3 n) {
    const V3 from = Gather3(p.p_x, p.p_y, p.p_z, slots);
    const VF clearance = Clearance(from, q, Gather(p.p_error, slots));
    const VF side = hn::CopySign(clearance, Dot(n, from - q));
    const V3 to_light = MulAdd(n, side, q) - from;
    distance2 = Dot(to_light, to_light);
    distance = hn::Sqrt(distance2);
    direction = Mul(to_light, hn::Div(Splat(1.0f), distance));
    cos_light = hn::Neg(Dot(n, direction));
  }
  /// Converts a density over the light's area to one over solid angle.
  LANELIGHT_INLINE VF PdfSa(VF pdf_area) const {
    return hn::Div(hn::Mul(pdf_area, distance2), hn::Abs(cos_light));
  }
};

/// The emission of surface lights.
struct SurfaceEmission {
  V3 radiance;
  MF two_sided;
};

/// Stores a light sample by a shadow ray with density pdf_sa (selection included).
LANELIGHT_INLINE void StoreShadowRay(const PathColumns& p, const StoreSlots& slots,
                                     const ShadowRay& ray, VF pdf_sa,
                                     const SurfaceEmission& light) {
  const MF facing = hn::Or(hn::Gt(ray.cos_light, Splat(0)), light.two_sided);
  const MF usable =
      hn::And(facing, hn::And(hn::Gt(pdf_sa, Splat(0)), hn::Lt(pdf_sa, Splat(1e30f))));
  StoreLightSample(p, slots,
                   {ray.direction, ray.distance,
                    Mul(light.radiance, hn::Div(Splat(1.0f), pdf_sa)), pdf_sa, usable});
}

/// A point of a surface light with its normal, chosen with that density (selection
/// included).
struct SurfacePoint {
  V3 q, n;
  VF pdf_area;
};

LANELIGHT_INLINE void StoreSurfaceSample(const PathColumns& p, const StoreSlots& slots,
                                         const SurfacePoint& point,
                                         const SurfaceEmission& light) {
  const ShadowRay ray(p, slots, point.q, point.n);
  StoreShadowRay(p, slots, ray, ray.PdfSa(point.pdf_area), light);
}

/// Adds weight * beta * radiance to the path.
LANELIGHT_INLINE void AddRadiance(const PathColumns& p, const StoreSlots& slots,
                                  V3 radiance) {
  V3 beta = Gather3(p.beta_r, p.beta_g, p.beta_b, slots);
  if (p.hit_weight != nullptr) beta = Mul(beta, Gather(p.hit_weight, slots));
  const V3 sum = Gather3(p.l_r, p.l_g, p.l_b, slots) + Mul(beta, radiance);
  Scatter3(sum, p.l_r, p.l_g, p.l_b, slots);
}

/// Returns the light of a colour, of light `index`, at the wavelengths of its paths.
inline HWY_NOINLINE V3 AtWavelengths(const Wave& wave, const Slots& slots, VI index,
                                     V3 color) {
  const SpectrumTable& table = *wave.spectra;
  const Wavelengths at(wave.path, slots);
  const VI row = Lookup(wave.lights->spectrum, index);
  const auto own = hn::Gt(row, hn::Set(DI(), -1));
  // The weights of Luminance() (src/base/core/vec.h), in which the rows are stated.
  const VF luminance = Dot(color, Splat3(0.212671f, 0.715160f, 0.072169f));
  const V3 by_row = Mul(AtRows(table, hn::IfThenElseZero(own, row), at), luminance);
  if (hn::AllTrue(DI(), own)) return by_row;
  return IfThenElse(hn::RebindMask(DF(), own), by_row, UpsampledColors(table, color, at));
}
/// Does the same in any scene: paths that carry red, green and blue see the colour.
LANELIGHT_INLINE V3 AsCarried(const Wave& wave, const Slots& slots, VI index, V3 color) {
  if (HWY_LIKELY(wave.path.wavelength == nullptr)) return color;
  return AtWavelengths(wave, slots, index, color);
}

LANELIGHT_END_KERNELS

#endif
