#include "src/render/train/training.h"

namespace lanelight {

bool NeedsTraining(const Plan& plan) {
  return plan.features.HasAny({Feature::kDecides, Feature::kSplitting,
                               Feature::kGuidedEmission, Feature::kLearnedLights});
}

TrainingOutcome Train(const TrainingContext& context) {
  const FeatureSet& features = context.plan.features;
  if (features.Has(Feature::kDecides)) return TrainDecision(context);
  TrainingOutcome first;
  if (features.Has(Feature::kLearnedLights) && !context.tables.lights.has_learned()) {
    first = TrainLightSelection(context);
    if (!context.tables.lights.has_learned()) return first;  // the user has stopped it
  }
  TrainingOutcome outcome;
  if (features.Has(Feature::kSplitting)) outcome = TrainPathValues(context);
  if (features.Has(Feature::kGuidedEmission)) outcome = TrainEmission(context);
  outcome.samples += first.samples;
  outcome.rays += first.rays;
  if (outcome.note.empty()) outcome.note = first.note;
  return outcome;
}

}  // namespace lanelight
