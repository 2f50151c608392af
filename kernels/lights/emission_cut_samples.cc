// Light samples on emitting shapes that alpha cuts: what is left at the sampled point.
// Rays meet that share of them (kernels/intersect/alpha-inl.h), so both techniques see
// the same light. A constant alpha of 0 leaves nothing to meet: such a lamp shines as if
// it were whole (as in pbrt-v4), light samples alone find it, and no weight is left to
// rays.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_stage.h"
#include "kernels/lights/sampled_points-inl.h"
#include "kernels/texture/texture-inl.h"
#include "src/scene/compiled/texture_table.h"

LANELIGHT_BEGIN_KERNELS

template <bool kMany>
void CutSamples(Wave& wave) {
  const SceneParts& scene = wave;
  const auto left = [&](const StoreSlots& slots, const Lights& light,
                        const PlacedPoint& at) HWY_ATTR {
    const VI prim = light.Primitive();
    const VI texture = Gather(scene.alpha->texture.data(), prim);
    const VF constant = Gather(scene.alpha->constant.data(), prim);
    const MF plain = hn::RebindMask(DF(), hn::Lt(texture, hn::Zero(DI())));
    const MF unseen = hn::And(plain, hn::Le(constant, Splat(0)));
    const VF pdf = Gather(wave.path.ls_pdf, slots);
    Scatter(hn::IfThenZeroElse(unseen, pdf), wave.path.ls_pdf, slots);
    const VF alpha = EvalFloats(*scene.textures, texture, at, constant);
    const VF share = hn::Min(hn::Max(alpha, Splat(0)), Splat(1.0f));
    return hn::IfThenElse(unseen, Splat(1.0f), share);
  };
  MultiplySamples<kMany>(wave, left);
}

Stage EmissionCutSamplesStage() {
  return EmittedThereStage(
      "light_emission_cut", "what alpha leaves of emitting shapes at sampled points",
      Feature::kEmissionCuts,
      ByFeature<Feature::kManyLights, CutSamples<true>, CutSamples<false>>);
}

LANELIGHT_END_KERNELS
