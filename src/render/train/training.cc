#include "src/render/train/training.h"

namespace lanelight {
namespace {

struct Training {
  Feature asks;
  TrainingOutcome (*train)(const TrainingContext&);
};

constexpr Training kTrainings[] = {
#define X(name, feature) {Feature::feature, Train##name},
    LANELIGHT_TRAININGS(X)
#undef X
};

}  // namespace

void TrainingOutcome::Add(const TrainingOutcome& next) {
  const auto join = [](std::string& all, const char* between, const std::string& more) {
    all += (all.empty() || more.empty() ? "" : between) + more;
  };
  changes = JoinedChanges(changes, next.changes);
  join(note, "; ", next.note);
  samples += next.samples;
  rays += next.rays;
}

bool NeedsTraining(const Plan& plan) {
  if (plan.features.Has(Feature::kDecides)) return true;
  for (const Training& t : kTrainings) {
    if (plan.features.Has(t.asks)) return true;
  }
  return false;
}

TrainingOutcome Train(const TrainingContext& context) {
  if (context.plan.features.Has(Feature::kDecides)) return TrainDecision(context);
  TrainingOutcome all;
  for (const Training& t : kTrainings) {
    if (!context.plan.features.Has(t.asks)) continue;
    all.Add(t.train(context));
  }
  return all;
}

}  // namespace lanelight
