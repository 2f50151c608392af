// Emission of hit triangles and rectangles, weighted against light sampling of the same
// point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/flat-inl.h"
#include "kernels/lights/flat_hits-inl.h"
#include "kernels/lights/light_image-inl.h"
#include "kernels/lights/light_stage.h"
#include "src/vocabulary/path/wave.h"

LANELIGHT_BEGIN_KERNELS

// Returns the density with which the light of a triangle that was hit is sampled there:
// by solid angle where that is not too small, else `by_area`. The origin of the ray is
// the point that was lit, up to rounding.
template <LightPoints kPoints, class Seen>
HWY_INLINE VF PdfAtHit(const PathColumns& p, const Slots& slots, const Seen& seen, VF pmf,
                       VF by_area) {
  VF pdf = hn::Div(pmf, seen.omega);
  if constexpr (kPoints == LightPoints::kProjected) {
    const Bilinear weights =
        seen.Weights(Gather3(p.start_n_x, p.start_n_y, p.start_n_z, slots));
    pdf = hn::Mul(pdf, weights.Pdf(seen.Square(p, slots)));
  }
  return hn::IfThenElse(BySolidAngle(seen.omega), pdf, by_area);
}

template <LightShape kShape, bool kMis, LightPoints kPoints, bool kImages>
void EmissionOfFlat(Wave& wave) {
  const PathColumns& p = wave.path;
  const SceneParts& scene = wave;
  const Queue& mine = HitsOf(wave, kShape);
  ForEachBatch(wave, mine, [&](const StoreSlots& slots, MF) HWY_ATTR {
    const VI prim = Gather(p.prim, slots);
    const VI index = LightOfTriangle(scene, prim);
    const Lights light(scene, index);
    const LightTriangle triangle(scene, prim);
    const VF cosine = hn::Neg(Dot(triangle.n, Gather3(p.d_x, p.d_y, p.d_z, slots)));
    const MF facing = hn::Or(hn::Gt(cosine, Splat(0)), light.TwoSided());
    VF weight = Splat(1.0f);
    if constexpr (kMis) {
      const VF t = HitDistance(p, slots), pmf = Pmf(wave, slots, index);
      VF pdf =
          hn::Div(hn::Mul(hn::Mul(pmf, t), t), hn::Mul(light.Area(), hn::Abs(cosine)));
      if constexpr (kPoints != LightPoints::kArea) {
        const V3 from = ScatteredFrom(p, slots);
        if constexpr (kShape == LightShape::kTriangle) {
          const VisibleTriangle seen(triangle, from);
          pdf = PdfAtHit<kPoints>(p, slots, seen, pmf, pdf);
        } else {
          const LightRectangle rectangle(light);
          const VisibleRectangle seen(rectangle, from);
          pdf = PdfAtHit<kPoints>(p, slots, seen, pmf, pdf);
        }
      }
      weight = EmissionWeight(wave.run->mis, Gather(p.bsdf_pdf, slots), pdf);
    }
    V3 radiance = light.Radiance();
    if constexpr (kImages) {
      const LightUv at =
          TriangleUv(*scene.geometry, prim, Gather(p.b1, slots), Gather(p.b2, slots));
      radiance = Mul(radiance, ImageAt(scene, light, at));
    }
    radiance = AsCarried(wave, slots, index, radiance);
    AddRadiance(p, slots, IfThenElseZero(facing, Mul(radiance, weight)));
  });
}

template <LightShape kShape>
StageFn ResolveEmissionOfFlat(const FeatureSet& features) {
  const bool images = features.Has(Feature::kEmissionImages);
  if (!features.Has(Feature::kMis)) {
    return images ? EmissionOfFlat<kShape, false, LightPoints::kArea, true>
                  : EmissionOfFlat<kShape, false, LightPoints::kArea, false>;
  }
  return ByLightPoints(features, Feature::kProjectedHits, [&](auto points) -> StageFn {
    return images ? EmissionOfFlat<kShape, true, decltype(points)::value, true>
                  : EmissionOfFlat<kShape, true, decltype(points)::value, false>;
  });
}

Stage EmissionTriangleStage() {
  return EmissionStage("emission_triangle", "adds the emission of hit triangles",
                       Feature::kTriangleLights,
                       ResolveEmissionOfFlat<LightShape::kTriangle>);
}
Stage EmissionRectangleStage() {
  return EmissionStage("emission_rectangle", "adds the emission of hit rectangles",
                       Feature::kRectangleLights,
                       ResolveEmissionOfFlat<LightShape::kRectangle>);
}

LANELIGHT_END_KERNELS
