// The registry of stages: one line each, in the order of execution. The plan keeps those
// that the scene needs (src/render/plan/plan.cc). A file in kernels/ with a stage and no
// line here fails tests/render/plan/registry_test.cc; a line without a file fails to
// link.
#pragma once

#include "kernels/simd/target.h"
#include "src/vocabulary/path/stage.h"

namespace lanelight {

// The stage that shades a kind of material.
#define LANELIGHT_SHADE_STAGE(name, traits, meaning) X(Shade##name)

// X(name), by that name: the list of shading stages asks for it.
#define LANELIGHT_STAGES(X)                    \
  X(Generate)                                  \
  X(IndependentCamera)                         \
  X(StratifiedCamera)                          \
  X(SobolCamera)                               \
  X(HaltonCamera)                              \
  X(AntitheticCamera)                          \
  X(FirstFilm)                                 \
  X(FilterPlace)                               \
  X(PerspectiveCamera)                         \
  X(OrthographicCamera)                        \
  X(SphericalCamera)                           \
  X(RealisticCamera)                           \
  X(EmitLightPath)                             \
  X(Motion)                                    \
  X(IntersectTriangles)                        \
  X(IntersectSpheres)                          \
  X(IntersectDisks)                            \
  X(IntersectPlanes)                           \
  X(IntersectLargeSpheres)                     \
  X(IntersectCurves)                           \
  X(MediumDistance)                            \
  X(MediumTracking)                            \
  X(Hits)                                      \
  X(WeighHits)                                 \
  X(WeighEscaped)                              \
  X(Escape)                                    \
  X(HitLightTree)                              \
  X(EmissionTriangle)                          \
  X(EmissionRectangle)                         \
  X(EmissionSphere)                            \
  X(EmissionDisk)                              \
  X(Limit)                                     \
  X(SurfaceTriangle)                           \
  X(SurfaceSphere)                             \
  X(SurfaceDisk)                               \
  X(SurfacePlane)                              \
  X(SurfaceLargeSphere)                        \
  X(SurfaceCurve)                              \
  X(Interfaces)                                \
  X(Footprints)                                \
  X(Mix)                                       \
  X(Regularize)                                \
  X(Bumps)                                     \
  X(NormalMaps)                                \
  X(Texture)                                   \
  X(Spectra)                                   \
  X(TextureSpectra)                            \
  X(Disperse)                                  \
  X(ForceDiffuse)                              \
  X(Aov)                                       \
  X(Gbuffer)                                   \
  X(Vertices)                                  \
  X(RecordVertex)                              \
  X(SinglePathBefore)                          \
  X(AdjointRoulette)                           \
  X(SinglePathAfter)                           \
  X(IndependentBounce)                         \
  X(StratifiedBounce)                          \
  X(SobolBounce)                               \
  X(HaltonBounce)                              \
  X(AntitheticBounce)                          \
  X(FirstBounce)                               \
  X(SecondVertices)                            \
  X(LightPathArrive)                           \
  X(Route)                                     \
  X(ChooseGlass)                               \
  X(ChooseThinGlass)                           \
  X(ChooseSheet)                               \
  X(ChooseCoat)                                \
  X(ChooseRoughCoat)                           \
  X(BeginCandidates)                           \
  X(SelectLight)                               \
  X(SelectLightTree)                           \
  X(SelectLearnedLight)                        \
  X(SampleTriangleLight)                       \
  X(SampleRectangleLight)                      \
  X(SampleSphereLight)                         \
  X(SampleDiskLight)                           \
  X(SamplePointLight)                          \
  X(SampleSpotLight)                           \
  X(SampleDistantLight)                        \
  X(SampleImageLight)                          \
  X(SampleInfiniteConstant)                    \
  X(SampleInfiniteImage)                       \
  X(SamplePortalLight)                         \
  X(SampleCamera)                              \
  X(EmissionImageSamples)                      \
  X(EmissionCutSamples)                        \
  X(LightSpectra)                              \
  X(Consider)                                  \
  X(KeepCandidate)                             \
  LANELIGHT_SHADE_KINDS(LANELIGHT_SHADE_STAGE) \
  X(WeighConnections)                          \
  X(ShadowTriangles)                           \
  X(ShadowSpheres)                             \
  X(ShadowDisks)                               \
  X(ShadowPlanes)                              \
  X(ShadowLargeSpheres)                        \
  X(ShadowCurves)                              \
  X(ShadowMedia)                               \
  X(ShadowThrough)                             \
  X(RecordLight)                               \
  X(Connect)                                   \
  X(KeepSplats)                                \
  X(SecondVerticesLight)                       \
  X(LightPathLeave)                            \
  X(SinglePathDecision)                        \
  X(ConstantRoulette)                          \
  X(ThroughputRoulette)                        \
  X(RecordPath)                                \
  X(SinglePathEnd)                             \
  X(EnterMedia)                                \
  X(PassInterfaces)                            \
  X(Accumulate)                                \
  X(EndLightPath)                              \
  X(Compact)                                   \
  X(ReuseOwnLight)                             \
  X(ReusePairs)                                \
  X(ReuseGlossy)                               \
  X(ReuseShadow)                               \
  X(ReuseConnect)

/// A stage, with the kernels of a target.
using StageOn = Stage (*)(SimdTarget target);
#define X(name) Stage name##Stage(SimdTarget target);
LANELIGHT_STAGES(X)
#undef X

}  // namespace lanelight
