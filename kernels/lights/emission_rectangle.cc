// Emission of hit rectangles, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_rectangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/emission_flat-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

StageFn ResolveEmissionRectangle(const FeatureSet& features) {
  return ResolveEmissionOfFlat<LightShape::kRectangle>(features);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(ResolveEmissionRectangle);

Stage EmissionRectangleStage() {
  return EmissionStage("emission_rectangle", "adds the emission of hit rectangles",
                       Feature::kRectangleLights, [](const FeatureSet& features) {
                         return HWY_DYNAMIC_DISPATCH(ResolveEmissionRectangle)(features);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
