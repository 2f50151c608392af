// Emission of hit spheres and disks, weighted against light sampling of the same point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_stage.h"
#include "kernels/lights/round_hits-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Shape, bool kMis, bool kImages>
void EmissionOfRound(Wave& wave) {
  const PathColumns& p = wave.path;
  const SceneParts& scene = wave;
  ForEachBatch(wave, RoundHitsOf<Shape>(wave), [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const VI index = LightOfRound<Shape>(scene, prim);
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
