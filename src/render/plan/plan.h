// The plan of a render: the stages, columns and kernel variants that this scene and these
// options need, and nothing else; with a reason for everything left out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kernels/simd/target.h"
#include "src/render/plan/phase.h"
#include "src/vocabulary/path/sample_planes.h"
#include "src/vocabulary/path/stage.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight {

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

struct PlanOptions {
  SimdTarget target;  // of all kernels
  std::uint32_t max_depth = 5;
  Auxiliary auxiliary = Auxiliary::kNone;
  bool spectral_film = false;   // samples keep their wavelengths for its buckets
  std::uint32_t wavefront = 0;  // paths; 0 = sized so that the live columns fit in L2
  /// Of a training pass (src/render/train/training.h): what it turns on to record. It has
  /// independent points, no pairs and no control variate.
  std::optional<FeatureSet> training;
  /// Of a training pass: it has the strategy's points all the same, and its reuse, so
  /// that its samples depend on each other as those of a render do.
  bool own_points = false;
  /// Instead of the scene's: what a training tries, or has found to be better (roulette,
  /// reuse, decide).
  std::optional<Strategy> strategy;
};

struct OmittedStage {
  Stage stage;
  std::string reason;  // "no spheres", ...
};

struct Plan {
  FeatureSet features;  // of scene and options together
  /// In the order of PhaseId; the first is that of paths. All work on the same columns.
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
