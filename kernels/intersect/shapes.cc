// Closest hit on spheres, disks, planes and large spheres, and shadow rays against them.
#include "kernels/simd/each_target-inl.h"

#include "kernels/intersect/shapes-inl.h"

LANELIGHT_BEGIN_KERNELS

template <class Shape>
Stage IntersectStage(const char* name, const char* meaning, Feature shape) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kActive,
          .role = StageRole::kIntersect,
          .needs = {shape},
          .reads = kClosestRay,
          .writes = {Field::t, Field::prim, Field::inst},
          .resolve = [](const FeatureSet& features) -> StageFn {
            const bool alpha = features.Has(Feature::kAlpha);
            if (features.Has(Feature::kInstances)) {
              return alpha ? IntersectShapes<Shape, true, true>
                           : IntersectShapes<Shape, false, true>;
            }
            return alpha ? IntersectShapes<Shape, true, false>
                         : IntersectShapes<Shape, false, false>;
          }};
}

template <class Shape>
Stage ShadowStage(const char* name, const char* meaning, Feature shape) {
  return {.name = name,
          .meaning = meaning,
          .input = QueueId::kShadow,
          .role = StageRole::kShadow,
          .needs = {shape, Feature::kLights, Feature::kOpaqueShadows},
          .reads = kShadowRay,
          .resolve = ByFeature<Feature::kAlpha, ShadowShapes<Shape, true>,
                               ShadowShapes<Shape, false>>};
}

Stage IntersectSpheresStage() {
  return IntersectStage<SphereShape>("intersect_spheres", "closest hit on spheres",
                                     Feature::kSpheres);
}
Stage IntersectDisksStage() {
  return IntersectStage<DiskShape>("intersect_disks", "closest hit on disks",
                                   Feature::kDisks);
}
Stage IntersectPlanesStage() {
  return IntersectStage<PlaneShape>("intersect_planes", "closest hit on planes",
                                    Feature::kPlanes);
}
Stage IntersectLargeSpheresStage() {
  return IntersectStage<LargeSphereShape>(
      "intersect_large_spheres", "closest hit on large spheres", Feature::kLargeSpheres);
}

Stage ShadowSpheresStage() {
  return ShadowStage<SphereShape>(
      "shadow_spheres", "removes shadow rays blocked by spheres", Feature::kSpheres);
}
Stage ShadowDisksStage() {
  return ShadowStage<DiskShape>("shadow_disks", "removes shadow rays blocked by disks",
                                Feature::kDisks);
}
Stage ShadowPlanesStage() {
  return ShadowStage<PlaneShape>("shadow_planes", "removes shadow rays blocked by planes",
                                 Feature::kPlanes);
}
Stage ShadowLargeSpheresStage() {
  return ShadowStage<LargeSphereShape>("shadow_large_spheres",
                                       "removes shadow rays blocked by large spheres",
                                       Feature::kLargeSpheres);
}

LANELIGHT_END_KERNELS
