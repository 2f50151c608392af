// A study from start to end: renders, analysis, files.
#pragma once

#include <vector>

#include "src/measure/study/study_json.h"

namespace lanelight {

/// Runs the study and writes DIR/study.json, study.csv and report.html beside the EXR
/// files. Scenes that failed are in the result with their error. Throws InputError if
/// nothing can be written, or DIR holds something else.
std::vector<SceneStudy> Study(const StudyOptions& options, const StudyHooks& hooks);

}  // namespace lanelight
