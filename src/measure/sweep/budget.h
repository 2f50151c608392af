// A time for a whole sweep (sweep --budget).
#pragma once

#include <cstddef>
#include <string>

#include "src/measure/sweep/sweep_file.h"
#include "src/render/job/parts.h"

namespace lanelight {

/// The cells and times of each process that renders a part.
struct BudgetPlan {
  std::size_t cells = 0;    // of a part
  double cell_seconds = 0;  // wall time of the render of each
  double load_seconds = 0;  // reading and building all scenes
};

/// Gives every cell the same time, so that each part of the sweep takes `seconds` in one
/// process: what compiling the scenes takes is measured and left out. OUT/budget.json
/// keeps the time of a cell, which later runs use, so that a larger budget keeps finished
/// cells and has room for others. Throws InputError for cells with samples, times or
/// targets of their own, and for more cells of that time than the budget has room for.
/// Also throws if a cell would have less than 0.05 seconds.
BudgetPlan PlanBudget(Sweep& sweep, double seconds, const Part& part,
                      const std::string& out);

/// Returns e.g. "budget 2 h: 32 cells of 3.6 min each, and 4 s to load the scenes", and
/// how many more cells there is room for.
std::string BudgetText(const BudgetPlan& plan, double seconds);

}  // namespace lanelight
