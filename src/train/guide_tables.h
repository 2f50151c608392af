// A guide as tables of numbers, to be kept with a film and shipped to other processes.
#pragma once

#include <vector>

#include "src/prepare/guide.h"
#include "src/wave/run_state.h"

namespace lanelight {

/// Nodes, and of each cell the squares of its leaves, their cumulative masses, and the
/// fraction; the rest follows. Nothing for a guide without nodes.
std::vector<TrainedTable> TakeGuide(const Guide& guide);

/// Puts it together again, with the same bits. Throws InputError for tables that are
/// missing or that kernels must not be given: they follow nodes and read cells without
/// asking. `out` stays as it is then.
void PutGuide(const std::vector<TrainedTable>& trained, Guide& out);

}  // namespace lanelight
