// Emission of hit triangles, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_triangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/emission_flat-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveEmissionTriangle(const FeatureSet& features) {
  return ResolveEmissionOfFlat<LightShape::kTriangle>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(ResolveEmissionTriangle);

Stage EmissionTriangleStage() {
  return EmissionStage("emission_triangle", "adds the emission of hit triangles",
                       Feature::kTriangleLights, [](const FeatureSet& features) {
                         return HWY_DYNAMIC_DISPATCH(ResolveEmissionTriangle)(features);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
