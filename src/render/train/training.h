// Training: short renders before the image, whose samples never enter it. A strategy asks
// for it with a feature that its choice turns on (src/vocabulary/strategy/choices.h). Its
// pass may turn on further features (PlanOptions::training), with columns, stages and
// planes of its own; results go into StrategyTables. They do not depend on the number of
// threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/render/plan/plan.h"
#include "src/render/wave/run_state.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

class RankPasses;  // src/render/train/rank_passes.h

struct TrainingOptions {
  std::uint64_t planned_samples = 0;  // of the image
  bool whole_image = true;            // not windows of it: light subpaths may be chosen
  const std::atomic<bool>* stop = nullptr;
  RankPasses* ranks = nullptr;  // that train together (src/render/train/rank_passes.h)
};

/// Least and most planned samples of the trial run of decide=pilot: fewer do not show the
/// rare bright samples that matter.
inline constexpr std::uint64_t kMaxTrialSamples = std::uint64_t{1} << 25;
inline constexpr std::uint64_t kMinTrialSamples = std::uint64_t{1} << 23;
/// Largest image that is tried with light subpaths, whose sums take 96 bytes per pixel.
inline constexpr std::uint64_t kMaxTrialSplatPixels = std::uint64_t{1} << 24;
/// Returns the planned samples of the trial run for an image of so many pixels, without a
/// time budget.
std::uint64_t DecidedBy(std::uint64_t pixels);

/// Inputs of a training: `plan` and `seed` are those of the image.
struct TrainingContext {
  const PreparedScene& scene;
  const Plan& plan;
  std::uint32_t seed = 0;
  const TrainingOptions& options;
  StrategyTables& tables;  // to be filled
};

/// Returns whether the plan's strategy needs training.
bool NeedsTraining(const Plan& plan);

/// Runs the training that the plan's strategy needs: with kSplitting TrainPathValues,
/// with kGuidedEmission TrainEmission; with kDecides TrainDecision, which trains what it
/// compares, and what it has chosen.
TrainingOutcome Train(const TrainingContext& context);
TrainingOutcome TrainPathValues(const TrainingContext& context);
TrainingOutcome TrainLightSelection(const TrainingContext& context);
TrainingOutcome TrainEmission(const TrainingContext& context);
TrainingOutcome TrainDecision(const TrainingContext& context);

/// Returns the values of a table. Throws InputError for an unknown name.
const std::vector<double>& TableOf(const std::vector<TrainedTable>& trained,
                                   const std::string& name);

/// Returns what Train has stored in the tables.
std::vector<TrainedTable> ExportTraining(const StrategyTables& tables);

/// Restores them bit by bit into `tables`, for an image of so many
/// pixels (the full one). Kernels do not check what they look up: throws InputError for
/// tables that are missing, have a wrong size, or do not match each other.
void ImportTraining(const std::vector<TrainedTable>& trained, std::uint64_t pixels,
                    StrategyTables& tables);

/// Throws InputError if kernels of the plan read tables that are still empty.
void CheckTrained(const Plan& plan, const StrategyTables& tables);

}  // namespace lanelight
