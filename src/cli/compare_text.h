// What `lanelight compare` prints for people.
#pragma once

#include <string>

#include "src/measure/compare/comparison.h"

namespace lanelight {

/// Lines of all measures, and the verdict last.
std::string ComparisonText(const ImageComparison& comparison);

}  // namespace lanelight
