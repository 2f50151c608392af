// Finds the features that a render needs: those of the scene, changed by its strategy and
// options.
#pragma once

#include <string>
#include <vector>

#include "src/render/plan/plan.h"

namespace lanelight {

FeatureSet PlanFeatures(const PreparedScene& scene, const PlanOptions& options);

/// Returns the strategy of a plan: that of the options, else the scene's, without what a
/// training pass omits.
Strategy PlannedStrategy(const PreparedScene& scene, const PlanOptions& options);

/// Returns the options with a changed strategy; `changes` as in --strategy, may be empty.
/// Throws InputError for unknown changes.
PlanOptions WithChanges(const PreparedScene& scene, PlanOptions options,
                        std::string_view changes);

/// Returns the changes with which a strategy renders before it has been trained.
std::string UntrainedChanges(const PreparedScene& scene, const PlanOptions& options);

/// Returns whether triangles or rectangles are sampled as lights.
bool SamplesFlatLights(const FeatureSet& features);

/// Returns whether the light samples of a vertex may differ.
bool SamplesOfLightDiffer(const FeatureSet& features);

/// Returns whether directly visible lights are integrated apart.
bool RendersLightsSeparately(const PreparedScene& scene);

/// Returns the features of light subpaths, for a plan with kLightPaths.
FeatureSet LightPathFeatures(FeatureSet features);

/// Returns the features of camera rays that end at the light they see: a subset of
/// PlanFeatures(), with the same sample points.
FeatureSet VisibleLightFeatures(const PreparedScene& scene, const PlanOptions& options);

/// Throws InputError for a strategy that cannot work on this scene, saying what would.
/// Returns explanations of choices that have no effect on it.
std::vector<std::string> CheckStrategy(const PreparedScene& scene,
                                       const PlanOptions& options);

struct PreparedScene;  // src/scene/prepare/prepared_scene.h

/// Everything of the scene's strategy that reaches the kernels and the film: features,
/// stages with their kernels, parameters that some stage reads, how samples are grouped,
/// the probabilities of the lights. The scene is prepared for the strategy
/// (WithStrategy), the plan made for it. Two strategies of one scene with equal keys give
/// the same samples, bit by bit, for the same work; with a probability of 2^-60 tables of
/// lights that differ have equal keys. Strategies that do the same in different ways (a
/// table of equal probabilities, and one found otherwise) may have different keys.
std::string PlanKey(const PreparedScene& scene, const Plan& plan);

}  // namespace lanelight
