// Emission of hit rectangles, weighted against light sampling of the same point.
#include "kernels/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lights/emission_rectangle.cc"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernels/lights/emission_flat-inl.h"
#include "src/compiled/scene.h"

HWY_BEFORE_NAMESPACE();
namespace lanelight {
namespace HWY_NAMESPACE {

struct RectangleShape {
  static constexpr LightShape kShape = LightShape::kRectangle;

  LANELIGHT_INLINE static VF SolidAngle(const Lights& light, const LightTriangle&,
                                        V3 from) {
    const LightRectangle rectangle(light);
    return rectangle.From(from).SolidAngle(rectangle.size_x, rectangle.size_y);
  }
};

void EmissionRectangleMis(Wave& wave) {
  EmissionOfFlat<RectangleShape, true, false>(wave);
}
void EmissionRectangleAngleMis(Wave& wave) {
  EmissionOfFlat<RectangleShape, true, true>(wave);
}
void EmissionRectanglePlain(Wave& wave) {
  EmissionOfFlat<RectangleShape, false, false>(wave);
}

}  // namespace HWY_NAMESPACE
}  // namespace lanelight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/lights/light_stage.h"

namespace lanelight {

HWY_EXPORT(EmissionRectangleMis);
HWY_EXPORT(EmissionRectangleAngleMis);
HWY_EXPORT(EmissionRectanglePlain);

Stage EmissionRectangleStage() {
  return EmissionStage("emission_rectangle", "adds the emission of hit rectangles",
                       Feature::kRectangleLights,
                       [](const FeatureSet& features) -> StageFn {
                         if (!features.Has(Feature::kMis))
                           return HWY_DYNAMIC_DISPATCH(EmissionRectanglePlain);
                         return features.Has(Feature::kSolidAngleLights)
                                    ? HWY_DYNAMIC_DISPATCH(EmissionRectangleAngleMis)
                                    : HWY_DYNAMIC_DISPATCH(EmissionRectangleMis);
                       });
}

}  // namespace lanelight
#endif  // HWY_ONCE
