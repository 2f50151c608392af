// Light samples on emitting shapes that alpha cuts: what is left at the sampled point.
// Rays meet that share of them (kernels/intersect/alpha-inl.h), so both techniques see
// the same light. A constant alpha of 0 leaves nothing to meet: such a lamp shines as if
// it were whole (as in pbrt-v4), light samples alone find it, and no weight is left to
// rays.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_cut_samples.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/sampled_points-inl.h"
#include "kernels/texture/texture-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

template <bool kMany>
void CutSamples(Wave& wave) {
  const CompiledScene& scene = *wave.scene;
  const auto left = [&](const StoreSlots& slots, const Lights& light,
                        const PlacedPoint& at) HWY_ATTR {
    const VI prim = light.Primitive();
    const VI texture = Gather(scene.alpha_texture.data(), prim);
    const VF constant = Gather(scene.alpha_constant.data(), prim);
    const MF plain = hn::RebindMask(DF(), hn::Lt(texture, hn::Zero(DI())));
    const MF unseen = hn::And(plain, hn::Le(constant, Splat(0)));
    const VF pdf = Gather(wave.path.ls_pdf, slots);
    Scatter(hn::IfThenZeroElse(unseen, pdf), wave.path.ls_pdf, slots);
    const VF alpha = EvalFloats(scene.textures, texture, at, constant);
    const VF share = hn::Min(hn::Max(alpha, Splat(0)), Splat(1.0f));
    return hn::IfThenElse(unseen, Splat(1.0f), share);
  };
  MultiplySamples<kMany>(wave, left);
}

void CutSamplesOne(Wave& wave) { CutSamples<false>(wave); }
void CutSamplesMany(Wave& wave) { CutSamples<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(CutSamplesOne);
HWY_EXPORT(CutSamplesMany);

Stage EmissionCutSamplesStage() {
  return EmittedThereStage(
      "light_emission_cut", "what alpha leaves of emitting shapes at sampled points",
      Feature::kEmissionCuts, [](const FeatureSet& features) -> StageFn {
        return features.Has(Feature::kManyLights) ? HWY_DYNAMIC_DISPATCH(CutSamplesMany)
                                                  : HWY_DYNAMIC_DISPATCH(CutSamplesOne);
      });
}

}  // namespace lanelight
#endif  // HWY_ONCE
