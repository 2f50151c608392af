// Comparisons as a page for a browser.
#pragma once

#include <string>
#include <vector>

#include "src/measure/compare/comparison.h"

namespace lanelight {

/// The complete page (ComparisonReportPage()) of comparisons of images with one
/// reference; as many as `tests`, in the same order, with their FLIP.
std::string ComparisonPage(const std::vector<NamedImage>& tests,
                           const NamedImage& reference,
                           const std::vector<ImageComparison>& comparisons);

}  // namespace lanelight
