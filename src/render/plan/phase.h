// A phase of a plan: stages that run together, and how often.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "src/vocabulary/path/stage.h"

namespace lanelight {

struct PlannedStage {
  Stage stage;
  StageFn kernel = nullptr;
};

/// X(name, prefix of its rows in a profile, meaning)
#define LANELIGHT_PHASES(X)                                                     \
  X(Paths, "", "paths of a range of samples")                                   \
  X(Tile, "", "path reuse: one sample of all pixels of a tile")                 \
  X(Block, "", "path reuse: one pixel block")                                   \
  X(VisibleLights, "seen: ", "camera rays at edges of directly visible lights") \
  X(FindEdges, "seen edges: ", "camera rays that find these edges, without spectra")

enum class PhaseId : int {
#define X(name, prefix, meaning) k##name,
  LANELIGHT_PHASES(X)
#undef X
};

struct Phase {
  PhaseId id = PhaseId::kPaths;
  /// Run until all samples of the work are done, a wave at a time; else run once.
  bool in_waves = false;
  FeatureSet features;               // that the kernels are variants for
  std::vector<PlannedStage> stages;  // in execution order
  /// Stages [first, last) run once for each candidate of a light sample
  /// (RunParameters::candidates). Empty if light samples are not resampled.
  std::size_t first_repeated = 0, last_repeated = 0;
  std::size_t first_row = 0;  // of its stages in a profile
};

/// Before the names of the phase's stages in a profile; may be empty.
std::string_view Prefix(PhaseId id);
const char* Meaning(PhaseId id);

}  // namespace lanelight
