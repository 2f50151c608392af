// The images of a study: for its report, and as EXR files beside it.
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "src/measure/report/page.h"
#include "src/measure/study/analysis.h"

namespace lanelight {

/// Adds mean, one repetition, variance of one render, and bias (mean less reference) of a
/// strategy at the level of `cells`; writes them to the scene's folder and puts their
/// names, which are paths below DIR without ".exr", into `strategy`.
void AddStrategyImages(const SceneRuns& runs, std::size_t index, const Cells& cells,
                       StrategyAnalysis& strategy, std::vector<ReportImage>& images);

/// Strategies whose images the report has at small sample counts too: those of the
/// paper's figures, if there are any, and the first one that is rendered.
std::set<std::size_t> PicturedStrategies(const SceneRuns& runs);

/// The first repetitions of a strategy at each level; it is one of `pictured` strategies.
struct LevelFirsts {
  std::size_t strategy, pictured;
  const std::vector<std::vector<Rgb>>& images;
};

/// After AddStrategyImages(): they go into the report, from the smallest count on, as far
/// as kLevelValues take all of them.
void AddLevelImages(const SceneRuns& runs, const LevelFirsts& firsts,
                    StrategyAnalysis& strategy, std::vector<ReportImage>& images);
inline constexpr std::size_t kLevelValues = kReportValues / 2;  // of a scene

/// The same for the reference and the diffuse models, whose files are there already,
/// unless the reference was read from elsewhere.
void AddSceneImages(const SceneRuns& runs, SceneAnalysis& analysis,
                    std::vector<ReportImage>& images);

/// "paper-plain", "points-sobol-pairs-antithetic": for file names.
std::string Slug(const std::string& text);

}  // namespace lanelight
