// The plan of a render: the stages, columns and kernel variants that this scene and these
// options need, and nothing else; with a reason for everything left out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kernels/simd/target.h"
#include "src/scene/prepare/prepared_scene.h"
#include "src/vocabulary/path/sample_planes.h"
#include "src/vocabulary/path/stage.h"

namespace lanelight {

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

struct PlannedStage {
  Stage stage;
  StageFn kernel = nullptr;
};
struct OmittedStage {
  Stage stage;
  std::string reason;  // "no spheres", ...
};

struct Plan {
  FeatureSet features;               // of scene and options together
  std::vector<PlannedStage> stages;  // in execution order
  /// Of blocks of paths that have ended (reuse=block), likewise.
  std::vector<PlannedStage> block_stages;
  /// Of camera rays that are followed to the light they see (seen-lights=apart): those of
  /// `stages` that these need, for `seen_features` alone, on the same columns.
  std::vector<PlannedStage> seen_stages;
  FeatureSet seen_features;
  /// Of them, [first, last) make and consider one candidate of a light sample: run once
  /// for each (RunParameters::candidates). None where light samples are not resampled.
  std::size_t first_repeated = 0, last_repeated = 0;
  /// For stages that send rays of their own; none without kInterfaces or kReuse.
  RayKernels ray_kernels;
  std::vector<OmittedStage> omitted;
  std::vector<Field> live_fields, absent_fields;
  std::size_t bytes_per_path = 0;
  std::uint32_t wavefront = 0;     // paths per wavefront
  std::uint32_t slots = 0;         // room in it: more where paths split
  std::vector<std::string> notes;  // choices of the strategy that do nothing here
  PlanOptions options;

  /// Rows of a profile before those of seen_stages, and all of them.
  std::size_t FirstSeenRow() const { return stages.size() + block_stages.size(); }
  std::size_t rows() const { return FirstSeenRow() + seen_stages.size(); }
};

/// The plan of the scene's strategy. Throws InputError for a strategy that cannot work on
/// this scene, CheckFailure if a stage would read a live column that no earlier stage
/// writes.
Plan MakePlan(const PreparedScene& scene, const PlanOptions& options);

}  // namespace lanelight
