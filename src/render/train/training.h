// Training: short renders before the image whose samples never enter it, from which a
// strategy learns. A strategy asks for one with a feature that its choice turns on
// (src/vocabulary/strategy/choices.h); its pass may turn on further features
// (PlanOptions::training), and with them columns, stages and planes of its own; what it
// learns goes into StrategyTables (kept: trained_tables.h). Results do not depend on the
// number of threads.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "src/render/plan/plan.h"
#include "src/render/wave/run_state.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

class RankPasses;  // src/render/train/rank_passes.h

struct TrainingOptions {
  std::uint64_t planned_samples = 0;  // of the image
  bool keep_roulette = false;         // even where another would be more efficient
  const std::atomic<bool>* stop = nullptr;
  RankPasses* ranks = nullptr;  // that train together (src/render/train/rank_passes.h)
};

/// Planned samples beyond which the pilot of decide=pilot does not grow, and that it is
/// planned for at least: fewer do not show what the rare bright samples do that matter.
inline constexpr std::uint64_t kMostDecidedBy = std::uint64_t{1} << 25;
inline constexpr std::uint64_t kLeastDecidedBy = std::uint64_t{1} << 23;
/// What that is for an image of so many pixels, unless a time budget says it.
std::uint64_t DecidedBy(std::uint64_t pixels);

/// What a training knows: `plan` and `seed` are those of the image.
struct TrainingContext {
  const PreparedScene& scene;
  const Plan& plan;
  std::uint32_t seed = 0;
  const TrainingOptions& options;
  StrategyTables& tables;  // to be filled
};

// X(name, feature that asks for it), in the order in which they run. Each is a function
// Train<name> in a file of its own. With kDecides TrainDecision runs instead, which
// trains what it compares, and what it has chosen.
#define LANELIGHT_TRAININGS(X) \
  X(PathValues, kPathValues)   \
  X(ShadowWorth, kContributionShadowRoulette)

#define X(name, feature) TrainingOutcome Train##name(const TrainingContext& context);
LANELIGHT_TRAININGS(X)
#undef X
TrainingOutcome TrainDecision(const TrainingContext& context);

/// A strategy of the plan asks for training.
bool NeedsTraining(const Plan& plan);

/// Runs what the plan's strategy asks for.
TrainingOutcome Train(const TrainingContext& context);

}  // namespace lanelight
