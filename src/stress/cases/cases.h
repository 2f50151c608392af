// The cases of the stress suite, one function per file.
#pragma once

#include <vector>

#include "src/stress/stress_case.h"

namespace lanelight::stress {

/// All of them, in the order of the report.
std::vector<Case> AllCases();

void AddUnitCases(std::vector<Case>& cases);  // units.cc: length, radiance, distance

}  // namespace lanelight::stress
