// A stage is one kernel file plus one line in kernels/stages.h. It says what it needs,
// reads and writes; the plan (src/render/plan/plan.h) keeps the stages that the scene
// needs, checks that every live column read has been written, and resolves the kernel
// once. Kernels are those of one SIMD target (kernels/stages.h).
#pragma once

#include "src/vocabulary/path/wave.h"

namespace lanelight {

/// The unit of work of a stage.
enum class StageScope : std::uint8_t {
  kWave,  // paths, by its input queue
  // Paths that have ended (Wave::block, src/vocabulary/path/block.h):
  kTile,  // one sample of all pixels of a tile
  kBlock  // of these one block
};

/// The roles of stages: X(name, meaning)
#define LANELIGHT_STAGE_ROLES(X)                          \
  X(Camera, "starts paths and their camera rays")         \
  X(Sampling, "sample points")                            \
  X(Intersect, "closest hits")                            \
  X(Media, "events in media, and their interfaces")       \
  X(Sort, "sorts paths into queues")                      \
  X(Emission, "light that rays hit")                      \
  X(Surface, "point and normals of hits")                 \
  X(Texture, "textures and spectra of materials")         \
  X(Light, "samples of lights")                           \
  X(Resample, "candidates of light samples")              \
  X(Shade, "scattering")                                  \
  X(Shadow, "removes or attenuates occluded shadow rays") \
  X(Roulette, "Russian roulette and splitting")           \
  X(Record, "records for training and path reuse")        \
  X(Accumulate, "adds light to samples, and ends them")   \
  X(Block, "path reuse of pixel blocks")

enum class StageRole : std::uint8_t {
#define X(name, meaning) k##name,
  LANELIGHT_STAGE_ROLES(X)
#undef X
};
/// "camera", ...
const char* Name(StageRole role);

struct Stage {
  const char* name;     // also the profile row
  const char* meaning;  // one line
  QueueId input;        // skipped when empty
  StageRole role;
  FeatureSet needs = {};  // all of these, or the stage is absent
  FieldSet reads = {}, writes = {};
  StageScope scope = StageScope::kWave;
  /// Kernel for these features, which select among the stage's few template variants.
  StageFn (*resolve)(const FeatureSet& features);
};

/// Stage::resolve of a stage with one kernel.
template <StageFn kKernel>
StageFn Always(const FeatureSet&) {
  return kKernel;
}

/// Stage::resolve of a stage with a variant for one feature.
template <Feature kFeature, StageFn kWith, StageFn kWithout>
StageFn ByFeature(const FeatureSet& features) {
  return features.Has(kFeature) ? kWith : kWithout;
}

}  // namespace lanelight
