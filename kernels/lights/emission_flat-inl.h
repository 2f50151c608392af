// Emission of hit triangles, of lights that are one or a rectangle of two.
#if defined(LANELIGHT_LIGHTS_EMISSION_FLAT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_LIGHTS_EMISSION_FLAT_INL_H_
#undef LANELIGHT_LIGHTS_EMISSION_FLAT_INL_H_
#else
#define LANELIGHT_LIGHTS_EMISSION_FLAT_INL_H_
#endif

#include "kernels/lights/geometry-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

/// Index of the light of triangle `prim`; -1: none.
LANELIGHT_INLINE VI LightOfTriangle(const CompiledScene& scene, VI prim) {
  const int32_t* words =
      reinterpret_cast<const int32_t*>(scene.geometry.triangles.data());
  return Gather(words + offsetof(TriangleRecord, light) / 4,
                hn::Mul(prim, hn::Set(DI(), sizeof(TriangleRecord) / 4)));
}

/// The slots of kHit that hit a triangle of a light of this shape.
HWY_INLINE const Queue& HitsOf(Wave& wave, LightShape shape) {
  const DI di;
  const CompiledScene& scene = *wave.scene;
  const VI end = hn::Set(di, static_cast<int32_t>(scene.geometry.ranges.spheres));
  const PrimitiveSpan lit = EmittingSpan(scene.lights);
  const VI begin = hn::Set(di, static_cast<int32_t>(lit.first));
  const VI last = hn::Set(di, static_cast<int32_t>(lit.last));
  const VI wanted = hn::Set(di, static_cast<int32_t>(shape));
  return FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
    const VI prim = Gather(wave.path.prim, slots);
    const auto outside = hn::Or(hn::Lt(prim, begin), hn::Gt(prim, last));
    const auto triangle = hn::AndNot(outside, hn::Lt(prim, end));
    if (hn::AllFalse(di, triangle)) return hn::RebindMask(DF(), triangle);
    const VI index = LightOfTriangle(scene, hn::IfThenElseZero(triangle, prim));
    const auto emits = hn::And(triangle, hn::Gt(index, hn::Set(di, -1)));
    const Lights light(scene, hn::IfThenElseZero(emits, index));
    return hn::RebindMask(
        DF(), hn::And(emits, hn::Eq(light.I(offsetof(LightRecord, shape)), wanted)));
  });
}

/// Shape has kShape and SolidAngle(scene, light, prim, from), with which its stage
/// samples.
template <class Shape, bool kMis, bool kSolidAngle>
HWY_INLINE void EmissionOfFlat(Wave& wave) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  const Queue& mine = HitsOf(wave, Shape::kShape);
  ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const Lights light(scene, LightOfTriangle(scene, prim));
    const LightTriangle triangle(scene, prim);
    const VF cosine = hn::Neg(Dot(triangle.n, Gather3(p.d_x, p.d_y, p.d_z, slots)));
    const MF facing = hn::Or(hn::Gt(cosine, Splat(0)), light.TwoSided());
    VF weight = Splat(1.0f);
    if constexpr (kMis) {
      const VF t = Gather(p.t, slots), pmf = light.Pmf(p, slots);
      VF pdf =
          hn::Div(hn::Mul(hn::Mul(pmf, t), t), hn::Mul(light.Area(), hn::Abs(cosine)));
      if constexpr (kSolidAngle) {
        // The origin of the ray is the point that was lit, but for rounding.
        const VF omega =
            Shape::SolidAngle(light, triangle, Gather3(p.o_x, p.o_y, p.o_z, slots));
        pdf = hn::IfThenElse(BySolidAngle(omega), hn::Div(pmf, omega), pdf);
      }
      weight = EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots), pdf);
    }
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(light.Radiance(), weight)));
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#endif
