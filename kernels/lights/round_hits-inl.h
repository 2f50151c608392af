// Rays that hit emitting spheres and disks.
#ifndef LANELIGHT_LIGHTS_ROUND_HITS_INL_H_
#define LANELIGHT_LIGHTS_ROUND_HITS_INL_H_

#include "kernels/lights/light_image-inl.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

/// A batch of hits on one shape: its records, the normal n, the density with which a
/// light sample would have been taken there, and the coordinates of images.
struct EmittingSphere {
  using Record = SphereRecord;
  static constexpr auto kRecords = &Geometry::spheres;
  static constexpr auto kFirst = &PrimitiveRanges::spheres,
                        kNext = &PrimitiveRanges::disks;

  LightSphere sphere;
  V3 from, n;
  VF distance;

  HWY_INLINE EmittingSphere(const SceneParts& scene, const PathColumns& p,
                            const Slots& slots, VI prim, V3 d)
      : sphere(scene, prim),
        from(ScatteredFrom(p, slots)),
        distance(HitDistance(p, slots)) {
    n = Mul(MulAdd(d, distance, from) - sphere.center,
            hn::Div(sphere.normal_sign, sphere.radius));
  }
  HWY_INLINE VF Distance(const PathColumns&, const Slots&) const { return distance; }
  HWY_INLINE VF PdfSa(const Lights& light, VF pmf, VF by_area) const {
    const V3 to_center = sphere.center - from;
    const VF d2 = Dot(to_center, to_center);
    const VF cone = hn::Div(
        pmf, hn::Mul(Splat(6.28318530717958648f), OneMinusCosCone(sphere.radius, d2)));
    return hn::IfThenElse(hn::Gt(d2, light.ConeFrom()), cone, by_area);
  }
  HWY_INLINE LightUv Uv(const SceneParts& scene, VI prim, V3) const {
    return SphereUv(scene, prim, Mul(n, sphere.normal_sign));
  }
};

struct EmittingDisk {
  using Record = DiskRecord;
  static constexpr auto kRecords = &Geometry::disks;
  static constexpr auto kFirst = &PrimitiveRanges::disks,
                        kNext = &PrimitiveRanges::planes;

  LightDisk disk;
  V3 n;

  HWY_INLINE EmittingDisk(const SceneParts& scene, const PathColumns&, const Slots&,
                          VI prim, V3)
      : disk(scene, prim), n(disk.n) {}
  HWY_INLINE VF Distance(const PathColumns& p, const Slots& slots) const {
    return HitDistance(p, slots);
  }
  HWY_INLINE VF PdfSa(const Lights&, VF, VF by_area) const { return by_area; }
  HWY_INLINE LightUv Uv(const SceneParts& scene, VI prim, V3 hit) const {
    return DiskUv(scene, prim, disk, hit - disk.center);
  }
};

/// Returns the index of the light of a primitive of this shape; -1: none.
template <class Shape>
HWY_INLINE VI LightOfRound(const SceneParts& scene, VI prim) {
  const auto first = static_cast<int32_t>(scene.ranges->*Shape::kFirst);
  return RecordWords((scene.geometry->*Shape::kRecords).data(),
                     hn::Sub(prim, hn::Set(DI(), first)))
      .I(offsetof(typename Shape::Record, light));
}

/// Returns the slots of kHit that hit an emitting primitive of this shape.
template <class Shape>
HWY_INLINE const Queue& RoundHitsOf(Wave& wave) {
  const SceneParts& scene = wave;
  const VI begin = hn::Set(DI(), static_cast<int32_t>(scene.ranges->*Shape::kFirst));
  const VI before = hn::Sub(begin, hn::Set(DI(), 1));
  const VI end = hn::Set(DI(), static_cast<int32_t>(scene.ranges->*Shape::kNext));
  return FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
    const VI prim = Gather(wave.path.prim, slots);
    const auto round = hn::And(hn::Gt(prim, before), hn::Lt(prim, end));
    const VI light = LightOfRound<Shape>(scene, hn::IfThenElse(round, prim, begin));
    return hn::RebindMask(DF(), hn::And(round, hn::Gt(light, hn::Set(DI(), -1))));
  });
}

LANELIGHT_END_KERNELS

#endif
