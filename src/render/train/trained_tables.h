// What a training has learned as tables of numbers, to be kept with a film and shipped to
// other processes; and back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/render/plan/plan.h"
#include "src/render/wave/run_state.h"
#include "src/scene/prepare/tables.h"

namespace lanelight {

/// The values of a table. Throws InputError if there is none of this name.
const std::vector<double>& TableOf(const std::vector<TrainedTable>& trained,
                                   const std::string& name);

/// What Train has put into the tables.
std::vector<TrainedTable> TakeTraining(const StrategyTables& tables);

/// Puts it back, with the same bits, into tables that MakeStrategyTables has made for an
/// image of so many pixels (the full one). Kernels look values up without asking: throws
/// InputError for tables that are missing, whose size is not right, or that do not fit
/// each other.
void PutTraining(const std::vector<TrainedTable>& trained, std::uint64_t pixels,
                 StrategyTables& tables);

/// Throws InputError if kernels of the plan read tables that are still empty.
void CheckTrained(const Plan& plan, const StrategyTables& tables);

}  // namespace lanelight
