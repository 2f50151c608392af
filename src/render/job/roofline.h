// How far a stage is from the limits of the machine, after Williams, Waterman and
// Patterson 2009 ("Roofline"), as far as there are numbers for it.
#pragma once

#include "src/render/job/profile_report.h"

namespace lanelight {

/// From this part of a limit on, a stage counts as bound by it.
inline constexpr double kBoundFrom = 0.6;

/// Fills bandwidth, of_peak and bound of a row from its counts. `level`: where the
/// columns live. Columns alone can show that memory is the limit, never that it is not:
/// scene data (trees, triangles, textures, tables) is not in them. The processor's
/// counters can.
void PlaceOnRoofline(const Peaks& peaks, const MemoryLevel& level, ProfileRow& row);

}  // namespace lanelight
