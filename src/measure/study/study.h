// Runs a study, and writes its tables and images.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "src/measure/report/page.h"
#include "src/measure/study/analysis.h"

namespace lanelight {

/// A scene's renders and their analysis.
struct SceneStudy {
  SceneRuns runs;
  SceneAnalysis analysis;
};

/// Writes study.json (docs/study.md). `seconds`: wall clock of the study.
nlohmann::json StudyJson(const std::vector<SceneStudy>& scenes,
                         const StudyOptions& options, double seconds);

/// Returns study.csv, from the cells on disk.
std::string StudyCsv(const std::vector<SceneStudy>& scenes);

/// Runs the study and writes DIR/study.json, study.csv, report.html and EXR files. The
/// result includes failed scenes with their errors. Throws InputError if DIR cannot be
/// written, or has another study.
std::vector<SceneStudy> Study(const StudyOptions& options, const StudyHooks& hooks);

/// Adds mean, one repetition, variance of one render, and bias (mean minus reference) of
/// a strategy at the level of `cells`. Writes them to the scene's folder, and sets their
/// names (paths below DIR without ".exr") in `strategy`.
void AddStrategyImages(const SceneRuns& runs, std::size_t index, const Cells& cells,
                       StrategyAnalysis& strategy, std::vector<ReportImage>& images);

/// Returns strategies with images of all sample counts in the report: those of the
/// paper's figures, if any, and the first that is rendered.
std::set<std::size_t> PicturedStrategies(const SceneRuns& runs);

/// The first repetitions at each level of a strategy, which is one of `pictured`
/// strategies.
struct LevelFirsts {
  std::size_t strategy, pictured;
  const std::vector<std::vector<Rgb>>& images;
};

/// Adds them to the report after AddStrategyImages(), from the smallest count on, up to
/// kLevelValues.
void AddLevelImages(const SceneRuns& runs, const LevelFirsts& firsts,
                    StrategyAnalysis& strategy, std::vector<ReportImage>& images);
inline constexpr std::size_t kLevelValues = kReportValues / 2;  // of a scene

/// Adds the reference and the diffuse models to the report, and writes a reference that
/// was read from other files.
void AddSceneImages(const SceneRuns& runs, SceneAnalysis& analysis,
                    std::vector<ReportImage>& images);

/// Returns a text for file names, e.g. "points-sobol-pairs-antithetic".
std::string Slug(const std::string& text);

}  // namespace lanelight
