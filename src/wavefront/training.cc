#include "src/wavefront/training.h"

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
    const TrainingOutcome one = t.train(context);
    if (!one.changes.empty()) all.changes = one.changes;
    all.note += (all.note.empty() || one.note.empty() ? "" : "; ") + one.note;
    all.samples += one.samples;
    all.rays += one.rays;
  }
  return all;
}

}  // namespace lanelight
