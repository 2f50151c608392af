// Emission of hit spheres and disks, weighted against light sampling of the same point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_image-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "src/scene/geometry/geometry.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// A batch of hits on one shape: its records, the normal n, the density with which a light
// sample would have been taken there, and the coordinates of images.
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

template <class Shape, bool kMis, bool kImages>
void EmissionOfRound(Wave& wave) {
  const PathColumns& p = wave.path;
  const SceneParts& scene = wave;
  const PrimitiveRanges& ranges = *scene.ranges;
  const VI begin = hn::Set(DI(), static_cast<int32_t>(ranges.*Shape::kFirst));
  const VI before = hn::Sub(begin, hn::Set(DI(), 1));
  const VI end = hn::Set(DI(), static_cast<int32_t>(ranges.*Shape::kNext));
  const typename Shape::Record* records = (scene.geometry->*Shape::kRecords).data();
  const auto light_of = [&](VI index) HWY_ATTR {
    return RecordWords(records, index).I(offsetof(typename Shape::Record, light));
  };
  const Queue& mine =
      FilterQueue(wave, wave.queue(QueueId::kHit), [&](const Slots& slots) HWY_ATTR {
        const VI prim = Gather(p.prim, slots);
        const auto round = hn::And(hn::Gt(prim, before), hn::Lt(prim, end));
        const VI safe = hn::IfThenElseZero(round, hn::Sub(prim, begin));
        return hn::RebindMask(DF(),
                              hn::And(round, hn::Gt(light_of(safe), hn::Set(DI(), -1))));
      });
  ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const VI index = light_of(hn::Sub(prim, begin));
    const Lights light(scene, index);
    const V3 d = Gather3(p.d_x, p.d_y, p.d_z, slots);
    const Shape hits(scene, p, slots, prim, d);
    const VF cosine = hn::Neg(Dot(hits.n, d));
    const MF facing = hn::Or(hn::Gt(cosine, Splat(0)), light.TwoSided());
    VF weight = Splat(1.0f);
    if constexpr (kMis) {
      const VF t = hits.Distance(p, slots), pmf = Pmf(wave, slots, index);
      const VF by_area =
          hn::Div(hn::Mul(hn::Mul(pmf, t), t), hn::Mul(light.Area(), hn::Abs(cosine)));
      weight = EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots),
                              hits.PdfSa(light, pmf, by_area));
    }
    V3 radiance = light.Radiance();
    if constexpr (kImages) {
      const V3 hit = MulAdd(d, Gather(p.t, slots), Gather3(p.o_x, p.o_y, p.o_z, slots));
      radiance = Mul(radiance, ImageAt(scene, light, hits.Uv(scene, prim, hit)));
    }
    radiance = AsCarried(wave, slots, index, radiance);
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(radiance, weight)));
  });
}

template <class Shape>
StageFn ResolveEmissionOfRound(const FeatureSet& features) {
  const bool images = features.Has(Feature::kEmissionImages);
  if (features.Has(Feature::kMis)) {
    return images ? EmissionOfRound<Shape, true, true>
                  : EmissionOfRound<Shape, true, false>;
  }
  return images ? EmissionOfRound<Shape, false, true>
                : EmissionOfRound<Shape, false, false>;
}

Stage EmissionSphereStage() {
  return EmissionStage("emission_sphere", "adds the emission of hit spheres",
                       Feature::kSphereLights, ResolveEmissionOfRound<EmittingSphere>);
}
Stage EmissionDiskStage() {
  return EmissionStage("emission_disk", "adds the emission of hit disks",
                       Feature::kDiskLights, ResolveEmissionOfRound<EmittingDisk>);
}

LANELIGHT_END_KERNELS
