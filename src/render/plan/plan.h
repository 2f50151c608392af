// The plan of a render: the stages, columns and kernel variants that this scene and these
// options need, and nothing else; with a reason for everything left out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kernels/simd/target.h"
#include "src/vocabulary/path/run_parameters.h"
#include "src/vocabulary/path/stage.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct PlannedStage {
  Stage stage;
  StageFn kernel = nullptr;
};

enum class PhaseId : int {
  kPaths,
  kTile,
  kBlock,
  kLightPaths,
  kVisibleLights,
  kFindEdges
};

struct PhaseInfo {
  const char* prefix;  // of the names of its stages in a profile; may be empty
  const char* meaning;
};
/// The phases, by PhaseId.
inline constexpr PhaseInfo kPhases[] = {
    {"", "paths of a range of samples"},
    {"", "path reuse: one sample of all pixels of a tile"},
    {"", "path reuse: one pixel block"},
    {"light: ", "light subpaths"},
    {"visible: ", "camera rays at edges of directly visible lights"},
    {"edges: ", "camera rays that find these edges, without spectra"},
};
inline const PhaseInfo& InfoOf(PhaseId id) { return kPhases[int(id)]; }

struct Phase {
  PhaseId id = PhaseId::kPaths;
  /// Runs wave by wave until all samples of the work are done; otherwise runs once.
  bool in_waves = false;
  FeatureSet features;               // that the kernels are variants for
  std::vector<PlannedStage> stages;  // in execution order
  /// Stages [first, last) run once for each candidate of a light sample
  /// (RunParameters::candidates). Empty if light samples are not resampled.
  std::size_t first_repeated = 0, last_repeated = 0;
  std::size_t first_row = 0;  // of its stages in a profile
};

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

struct PlanOptions {
  SimdTarget target;  // of all kernels
  std::uint32_t max_depth = 5;
  Auxiliary auxiliary = Auxiliary::kNone;
  bool spectral_film = false;   // samples keep their wavelengths for its buckets
  std::uint32_t wavefront = 0;  // paths; 0 = sized so that the live columns fit in L2
  /// Features that a training pass (src/render/train/training.h) turns on to record. Such
  /// a pass has independent points, no antithetic pairs and no control variate.
  std::optional<FeatureSet> training;
  /// Keeps the strategy's points and path reuse in a training pass, so that its samples
  /// depend on each other as those of a render do.
  bool has_own_sequences = false;
  /// Replaces the scene's strategy: what a training tries or has chosen.
  std::optional<Strategy> strategy;
};

struct OmittedStage {
  Stage stage;
  std::string reason;  // "no spheres", ...
};

struct Plan {
  FeatureSet features;  // of scene and options together
  /// In the order of PhaseId, kPaths first. All work on the same columns.
  std::vector<Phase> phases;
  /// For stages that send rays of their own; none without kInterfaces or kReuse.
  RayKernels ray_kernels;
  std::vector<OmittedStage> omitted;
  std::vector<Field> live_fields, absent_fields;
  std::size_t bytes_per_path = 0;
  std::uint32_t wavefront = 0;     // paths per wavefront
  std::uint32_t slots = 0;         // room in it: more where paths split
  std::vector<std::string> notes;  // choices of the strategy that do nothing here
  PlanOptions options;

  const Phase& paths() const { return phases.front(); }
  /// Returns null if the plan does not have the phase.
  const Phase* Find(PhaseId id) const;
  /// Rows of a profile: the stages of all phases.
  std::size_t rows() const {
    return phases.back().first_row + phases.back().stages.size();
  }
};

/// The plan of the scene's strategy. Throws InputError for a strategy that cannot work on
/// this scene, CheckFailure if a stage would read a live column that no earlier stage
/// writes.
Plan MakePlan(const PreparedScene& scene, const PlanOptions& options);

}  // namespace lanelight
