// The images of a study: for its report, and as EXR files beside it.
#pragma once

#include <vector>

#include "src/study/analysis.h"

namespace lanelight {

/// Adds mean, one repetition, variance of one render, and bias (mean less reference) of a
/// strategy at the level of `cells`; writes them to the scene's folder and puts their
/// names, which are paths below DIR without ".exr", into `strategy`.
void AddStrategyImages(const SceneRuns& runs, std::size_t index, const Cells& cells,
                       StrategyAnalysis& strategy, std::vector<ReportImage>& images);

/// The same for the reference and the diffuse models, whose files are there already,
/// unless the reference was read from elsewhere.
void AddSceneImages(const SceneRuns& runs, SceneAnalysis& analysis,
                    std::vector<ReportImage>& images);

/// "paper-plain", "points-sobol-pairs-antithetic": for file names.
std::string Slug(const std::string& text);

}  // namespace lanelight
