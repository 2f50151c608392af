// What a render needs: the features of the scene, as changed by its strategy and by the
// options.
#pragma once

#include "src/render/plan/plan.h"

namespace lanelight {

FeatureSet PlanFeatures(const PreparedScene& scene, const PlanOptions& options);

/// The strategy of a plan of the scene: what the options leave of theirs, or of its own.
Strategy PlannedStrategy(const PreparedScene& scene, const PlanOptions& options);

/// The same options with a changed strategy; `changes` as in --strategy, may be empty.
/// Throws InputError for changes that there are not.
PlanOptions WithChanges(const PreparedScene& scene, PlanOptions options,
                        std::string_view changes);

/// Light samples of triangles or rectangles are taken in a plan of these features.
bool SamplesFlatLights(const FeatureSet& features);

/// Light samples of a vertex are not all the same in a plan of these features.
bool SamplesOfLightDiffer(const FeatureSet& features);

/// Returns whether the scene's strategy integrates lights apart, and it has any that can
/// be seen.
bool SeesLightsApart(const PreparedScene& scene);

/// Of camera rays that are followed to the light they see and no further: a part of
/// PlanFeatures(), with the same sample points.
FeatureSet SeenLightFeatures(const PreparedScene& scene, const PlanOptions& options);

}  // namespace lanelight
