// Light samples on emitting shapes with an image: what the image has at the sampled
// point. The samplers choose points as if the light were evenly bright; their densities
// stay.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_image_samples.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/emission_image-inl.h"
#include "kernels/queue/batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct Weights {
  VF b1, b2;
};

// Barycentric weights of the point of a triangle's plane that is nearest to q.
HWY_INLINE Weights WeightsOf(const CompiledScene& scene, VI prim, V3 q) {
  const LightTriangle triangle(scene, prim);
  const V3 e1 = triangle.e1, e2 = triangle.e2, d = q - triangle.p0;
  const VF a = Dot(e1, e1), b = Dot(e1, e2), c = Dot(e2, e2);
  const VF along1 = Dot(d, e1), along2 = Dot(d, e2);
  const VF inverse = hn::Div(Splat(1.0f), DifferenceOfProducts(a, c, b, b));
  return {hn::Mul(DifferenceOfProducts(c, along1, b, along2), inverse),
          hn::Mul(DifferenceOfProducts(a, along2, b, along1), inverse)};
}

HWY_INLINE LightUv UvOnTriangle(const CompiledScene& scene, const Lights& light, V3 q) {
  const Weights w = WeightsOf(scene, light.Primitive(), q);
  return TriangleUv(scene.geometry, light.Primitive(), w.b1, w.b2);
}

// A rectangle's points lie in one triangle or in the other.
HWY_INLINE LightUv UvOnRectangle(const CompiledScene& scene, const Lights& light, V3 q) {
  const VI first = light.Primitive();
  const VI second = light.I(offsetof(LightRecord, second_primitive));
  const Weights a = WeightsOf(scene, first, q), b = WeightsOf(scene, second, q);
  const auto least = [](const Weights& w) HWY_ATTR {
    const VF b0 = hn::Sub(hn::Sub(Splat(1.0f), w.b1), w.b2);
    return hn::Min(b0, hn::Min(w.b1, w.b2));
  };
  const MF in_first = hn::Ge(least(a), least(b));
  const VI prim = hn::IfThenElse(hn::RebindMask(DI(), in_first), first, second);
  return TriangleUv(scene.geometry, prim, hn::IfThenElse(in_first, a.b1, b.b1),
                    hn::IfThenElse(in_first, a.b2, b.b2));
}

HWY_INLINE LightUv UvOnSphere(const CompiledScene& scene, const Lights& light, V3 q) {
  const LightSphere sphere(scene, light.Primitive());
  return SphereUv(scene, light.Primitive(), Normalize(q - sphere.center));
}

HWY_INLINE LightUv UvOnDisk(const CompiledScene& scene, const Lights& light, V3 q) {
  const LightDisk disk(scene, light.Primitive());
  return DiskUv(scene, light.Primitive(), disk, q - disk.center);
}

template <bool kMany, class UvOn>
HWY_INLINE void ForShape(Wave& wave, LightShape shape, const UvOn& uv_on) {
  const PathColumns& p = wave.path;
  const CompiledScene& scene = *wave.scene;
  ForEachLit<kMany>(wave, shape, [&](const StoreSlots& slots, VI index) HWY_ATTR {
    const Lights light(scene, index);
    const V3 q =
        MulAdd(Gather3(p.ls_x, p.ls_y, p.ls_z, slots), Gather(p.ls_distance, slots),
               Gather3(p.p_x, p.p_y, p.p_z, slots));
    const V3 value = ImageAt(scene, light, uv_on(scene, light, q));
    const V3 radiance = Gather3(p.ls_r, p.ls_g, p.ls_b, slots);
    // A sample that is of no use may have no point.
    const MF used = hn::Gt(SumAbs(radiance), Splat(0));
    Scatter3(IfThenElseZero(used, Mul(radiance, value)), p.ls_r, p.ls_g, p.ls_b, slots);
  });
}

template <bool kMany>
void ImageSamples(Wave& wave) {
  const FeatureSet& features = wave.run->features;
  if (features.Has(Feature::kTriangleLights)) {
    ForShape<kMany>(wave, LightShape::kTriangle, UvOnTriangle);
  }
  if (features.Has(Feature::kRectangleLights)) {
    ForShape<kMany>(wave, LightShape::kRectangle, UvOnRectangle);
  }
  if (features.Has(Feature::kSphereLights)) {
    ForShape<kMany>(wave, LightShape::kSphere, UvOnSphere);
  }
  if (features.Has(Feature::kDiskLights)) {
    ForShape<kMany>(wave, LightShape::kDisk, UvOnDisk);
  }
}

void ImageSamplesOne(Wave& wave) { ImageSamples<false>(wave); }
void ImageSamplesMany(Wave& wave) { ImageSamples<true>(wave); }

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "src/path/stage.h"

namespace lanelight {

HWY_EXPORT(ImageSamplesOne);
HWY_EXPORT(ImageSamplesMany);

Stage EmissionImageSamplesStage() {
  return {.name = "light_emission_image",
          .meaning = "what the images of emitting shapes have at sampled points",
          .input = QueueId::kLit,
          .needs = {Feature::kEmissionImages, Feature::kSampledHittableLights,
                    Feature::kLights, Feature::kScatters},
          .reads = fields::kPoint | fields::kLightSample | FieldSet{Field::ls_light},
          .writes = fields::kLightSample,
          .resolve = [](const FeatureSet& features) -> StageFn {
            return features.Has(Feature::kManyLights)
                       ? HWY_DYNAMIC_DISPATCH(ImageSamplesMany)
                       : HWY_DYNAMIC_DISPATCH(ImageSamplesOne);
          }};
}

}  // namespace lanelight
#endif  // HWY_ONCE
