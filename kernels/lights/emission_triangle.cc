// Emission of hit triangles, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/emission_flat-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct TriangleShape {
  static constexpr LightShape kShape = LightShape::kTriangle;

  LANELIGHT_INLINE static VF SolidAngle(const Lights&, const LightTriangle& t, V3 from) {
    return SphericalTriangle(t.p0 - from, t.e1, t.e2).SolidAngle();
  }
};

void EmissionTriangleMis(Wave& wave) { EmissionOfFlat<TriangleShape, true, false>(wave); }
void EmissionTriangleAngleMis(Wave& wave) {
  EmissionOfFlat<TriangleShape, true, true>(wave);
}
void EmissionTrianglePlain(Wave& wave) {
  EmissionOfFlat<TriangleShape, false, false>(wave);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(EmissionTriangleMis);
HWY_EXPORT(EmissionTriangleAngleMis);
HWY_EXPORT(EmissionTrianglePlain);

Stage EmissionTriangleStage() {
  return EmissionStage("emission_triangle", "adds the emission of hit triangles",
                       Feature::kTriangleLights,
                       [](const FeatureSet& features) -> StageFn {
                         if (!features.Has(Feature::kMis))
                           return HWY_DYNAMIC_DISPATCH(EmissionTrianglePlain);
                         return features.Has(Feature::kSolidAngleLights)
                                    ? HWY_DYNAMIC_DISPATCH(EmissionTriangleAngleMis)
                                    : HWY_DYNAMIC_DISPATCH(EmissionTriangleMis);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
