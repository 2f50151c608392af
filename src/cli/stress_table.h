// What `lanelight stress` prints: the rows of a run, and the list of cases.
#pragma once

#include <string>
#include <vector>

#include "src/measure/stress/suite.h"

namespace lanelight {

/// A row per case, notes under those that failed, and the summary.
std::string StressTable(const stress::SuiteResult& result);

/// Name, what is extreme, what must be true, and the source of every case, by group.
std::string StressList(const std::vector<stress::Case>& cases);

}  // namespace lanelight
