// Joins the ranks that were started together. alone.cc and mpi_group.cc implement it; a
// program links one of them.
#pragma once

#include <memory>

#include "src/base/core/rank_group.h"

namespace lanelight {

/// Before anything else; both are as main has them.
std::unique_ptr<RankGroup> JoinRanks(int* argc, char*** argv);

}  // namespace lanelight
