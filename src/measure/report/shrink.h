// Images that are too many or too large for a page.
#pragma once

#include <cstddef>
#include <vector>

#include "src/measure/report/page.h"

namespace lanelight {

/// Values that a report holds at most: about 90 MB of text. More take a browser too long.
inline constexpr std::size_t kReportValues = 32'000'000;

/// Averages blocks of pixels in all images so that no more than `most` values are left.
/// Returns the side of a block; 1 if nothing had to be done.
int ShrinkImages(std::vector<ReportImage>& images, std::size_t most);

}  // namespace lanelight
