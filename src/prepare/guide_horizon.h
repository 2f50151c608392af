// Directions that a surface cannot scatter into.
#pragma once

#include <span>

#include "src/prepare/guide_cell.h"
#include "src/prepare/guide_records.h"

namespace lanelight {

/// Takes mass away from squares of directions behind the surfaces of a cell, if its
/// records say that nothing is scattered there: what is borrowed from cells of other
/// orientation lies there too, and a path that follows it ends. Leaves cells alone that
/// are bent by more than about 25 degrees, or let light through.
void LeaveOutBehind(std::span<const GuideRecord> records,
                    std::span<double, kGuideSquares> masses);

}  // namespace lanelight
