// Light samples on emitting shapes whose radiance varies, by an image or by alpha: these
// stages multiply samples by the value at their points. The samplers choose points as if
// the light were evenly bright; their densities stay.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/light_points-inl.h"
#include "kernels/lights/light_stage.h"
#include "kernels/queue/batch-inl.h"
#include "kernels/texture/mapping-inl.h"
#include "kernels/texture/texture-inl.h"

LANELIGHT_BEGIN_KERNELS

HWY_INLINE PlacedPoint PointOnTriangle(const SceneParts& scene, const Lights& light,
                                       V3 q) {
  const LightTriangle triangle(scene, light.Primitive());
  const LightUv uv = UvOnTriangle(scene, triangle, light.Primitive(), q);
  return {uv.u, uv.v, q, triangle.n};
}

HWY_INLINE PlacedPoint PointOnRectangle(const SceneParts& scene, const Lights& light,
                                        V3 q) {
  const VI first = light.Primitive();
  const VI second = light.I(offsetof(LightRecord, second_primitive));
  const LightTriangle triangle(scene, first);
  const LightUv uv = UvOnRectangle(scene, triangle, first, second, q);
  return {uv.u, uv.v, q, triangle.n};
}

HWY_INLINE PlacedPoint PointOnSphere(const SceneParts& scene, const Lights& light, V3 q) {
  const V3 out = Normalize(q - LightSphere(scene, light.Primitive()).center);
  const LightUv uv = SphereUv(scene, light.Primitive(), out);
  return {uv.u, uv.v, q, out};
}

HWY_INLINE PlacedPoint PointOnDisk(const SceneParts& scene, const Lights& light, V3 q) {
  const LightDisk disk(scene, light.Primitive());
  const LightUv uv = DiskUv(scene, light.Primitive(), disk, q - disk.center);
  return {uv.u, uv.v, q, disk.n};
}

// Multiplies the samples of one shape of light by factor(slots, light, point).
template <bool kMany, class PointOn, class Factor>
HWY_INLINE void MultiplyShape(Wave& wave, LightShape shape, const PointOn& point_on,
                              const Factor& factor) {
  const PathColumns& p = wave.path;
  const SceneParts& scene = wave;
  ForEachLit<kMany>(wave, shape, [&](const StoreSlots& slots, VI index) HWY_ATTR {
    const Lights light(scene, index);
    const V3 q =
        MulAdd(Gather3(p.ls_x, p.ls_y, p.ls_z, slots), Gather(p.ls_distance, slots),
               Gather3(p.p_x, p.p_y, p.p_z, slots));
    const auto value = factor(slots, light, point_on(scene, light, q));
    const V3 radiance = Gather3(p.ls_r, p.ls_g, p.ls_b, slots);
    // A sample that carries no light may have no point.
    const MF used = hn::Gt(SumAbs(radiance), Splat(0));
    Scatter3(IfThenElseZero(used, Mul(radiance, value)), p.ls_r, p.ls_g, p.ls_b, slots);
  });
}

// Multiplies the samples of all shapes that emit.
template <bool kMany, class Factor>
HWY_INLINE void MultiplySamples(Wave& wave, const Factor& factor) {
  const FeatureSet& features = wave.run->features;
  if (features.Has(Feature::kTriangleLights)) {
    MultiplyShape<kMany>(wave, LightShape::kTriangle, PointOnTriangle, factor);
  }
  if (features.Has(Feature::kRectangleLights)) {
    MultiplyShape<kMany>(wave, LightShape::kRectangle, PointOnRectangle, factor);
  }
  if (features.Has(Feature::kSphereLights)) {
    MultiplyShape<kMany>(wave, LightShape::kSphere, PointOnSphere, factor);
  }
  if (features.Has(Feature::kDiskLights)) {
    MultiplyShape<kMany>(wave, LightShape::kDisk, PointOnDisk, factor);
  }
}

// The image of the shape at the sampled point.
template <bool kMany>
void ImageSamples(Wave& wave) {
  MultiplySamples<kMany>(
      wave, [&](const StoreSlots&, const Lights& light, const PlacedPoint& at)
                HWY_ATTR { return ImageAt(wave, light, {at.u, at.v}); });
}

Stage EmissionImageSamplesStage() {
  return EmittedThereStage(
      "light_emission_image", "multiplies light samples by images of emitting shapes",
      Feature::kEmissionImages,
      ByFeature<Feature::kManyLights, ImageSamples<true>, ImageSamples<false>>);
}

// The alpha of the shape at the sampled point. Rays meet that share of the shape
// (kernels/intersect/alpha-inl.h), so both techniques see the same light. A constant
// alpha of 0 leaves nothing to meet: such a lamp shines as if it were whole (as in
// pbrt-v4), light samples alone find it, and no weight is left to rays.
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
    const VF fraction = hn::Min(hn::Max(alpha, Splat(0)), Splat(1.0f));
    return hn::IfThenElse(unseen, Splat(1.0f), fraction);
  };
  MultiplySamples<kMany>(wave, left);
}

Stage EmissionCutSamplesStage() {
  return EmittedThereStage(
      "light_emission_cut", "multiplies light samples by alpha of emitting shapes",
      Feature::kEmissionCuts,
      ByFeature<Feature::kManyLights, CutSamples<true>, CutSamples<false>>);
}

LANELIGHT_END_KERNELS
