// study.json and study.csv (docs/study.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "src/measure/study/analysis.h"

namespace lanelight {

inline constexpr int kStudySchema = 1;

/// A scene's renders with what they say.
struct SceneStudy {
  SceneRuns runs;
  SceneAnalysis analysis;
};

/// `seconds`: wall clock of the study.
nlohmann::json StudyJson(const std::vector<SceneStudy>& scenes,
                         const StudyOptions& options, double seconds);

/// All rows, reading the cells from the disk.
std::string StudyCsv(const std::vector<SceneStudy>& scenes);

}  // namespace lanelight
