// What a render needs: the features of the scene, as changed by its strategy and by the
// options.
#pragma once

#include "src/plan/plan.h"

namespace lanelight {

FeatureSet PlanFeatures(const CompiledScene& scene, const PlanOptions& options);

/// The scene's strategy as the options change it.
Strategy PlannedStrategy(const CompiledScene& scene, const PlanOptions& options);

/// Light samples of triangles or rectangles are taken in a plan of these features.
bool SamplesFlatLights(const FeatureSet& features);

/// Light samples of a vertex are not all the same in a plan of these features.
bool SamplesOfLightDiffer(const FeatureSet& features);

/// Whether the scene's strategy integrates lights apart, and it has any that can be seen.
bool SeesLightsApart(const CompiledScene& scene);

}  // namespace lanelight
