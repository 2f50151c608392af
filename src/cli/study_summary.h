// What a study says on the terminal.
#pragma once

#include <string>

#include "src/measure/study/study_json.h"

namespace lanelight {

/// Ranking table and verdict of one scene.
std::string StudySummary(const SceneStudy& study, const StudyOptions& options);

}  // namespace lanelight
