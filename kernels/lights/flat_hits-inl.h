// Rays that hit emitting triangles and rectangles.
#ifndef LANELIGHT_LIGHTS_FLAT_HITS_INL_H_
#define LANELIGHT_LIGHTS_FLAT_HITS_INL_H_

#include "kernels/lights/light-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/geometry/geometry.h"

LANELIGHT_BEGIN_KERNELS

/// Returns the index of the light of triangle `prim`; -1: none.
LANELIGHT_INLINE VI LightOfTriangle(const SceneParts& scene, VI prim) {
  return RecordWords(scene.geometry->triangles.data(), prim)
      .I(offsetof(TriangleRecord, light));
}

/// Returns the slots of kHit that hit a triangle of a light of this shape.
HWY_INLINE const Queue& HitsOf(Wave& wave, LightShape shape) {
  const DI di;
  const SceneParts& scene = wave;
  const VI end = hn::Set(di, static_cast<int32_t>(scene.ranges->spheres));
  const PrimitiveSpan lit = EmittingSpan(*scene.lights);
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

LANELIGHT_END_KERNELS

#endif
