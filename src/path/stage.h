// A stage is one kernel file plus one line in kernels/stages.h. It says what it needs,
// reads and writes; the plan (src/wavefront/plan.h) keeps the stages that the scene
// needs, checks that every live column read has been written, and resolves the kernel
// for the chosen SIMD target once.
#pragma once

#include "src/path/wave.h"

namespace lanelight {

struct Stage {
  const char* name;       // also the profile row
  const char* meaning;    // one line
  QueueId input;          // skipped when empty
  FeatureSet needs = {};  // all of these, or the stage is absent
  FieldSet reads = {}, writes = {};
  bool of_blocks = false;  // works on a block of paths that have ended: Wave::block
  /// Kernel for these features on the chosen target; the features select among the
  /// stage's few template variants.
  StageFn (*resolve)(const FeatureSet& features);
};

}  // namespace lanelight
