// Emission of hit triangles and rectangles, weighted against light sampling of the same
// point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/lights/emission_flat-inl.h"
#include "kernels/lights/light_stage.h"

LANELIGHT_BEGIN_KERNELS

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
