// What `lanelight profile` prints.
#pragma once

#include <string>

#include "src/render/job/profile_report.h"

namespace lanelight {

/// What was rendered and by what, the measured peaks, one row per stage, the sums. Lines
/// of at most 100 columns, as far as paths and names allow.
std::string ProfileText(const ProfileReport& report, const Job& job,
                        const RunResult& result, const std::string& scene);

}  // namespace lanelight
