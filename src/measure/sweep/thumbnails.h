// Small pictures of the cells, for the page.
#pragma once

#include <vector>

#include "src/measure/report/page.h"
#include "src/measure/sweep/groups.h"
#include "src/measure/sweep/sweep_folder.h"

namespace lanelight {

/// More groups than this have no pictures beyond the first so many.
inline constexpr std::size_t kMostThumbnails = 1000;

/// One for the first finished cell of each group, by the cell's name; all together about
/// 8 MB of text at most. An image that cannot be read is left out.
std::vector<ReportImage> Thumbnails(const Sweep& sweep, const SweepFolder& folder,
                                    const std::vector<CellGroup>& groups);

}  // namespace lanelight
