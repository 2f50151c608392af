// A guide from the numbers that it cannot be made without.
#pragma once

#include <span>
#include <string>

#include "src/prepare/guide.h"

namespace lanelight {

/// Completes `guide`, of which nodes, squares, cumulative masses and fractions are set:
/// densities and grids follow. Returns what kernels could not live with, in a few words;
/// empty if nothing: then nodes are a tree of at most kGuideDepth levels whose leaves
/// name cells, and the squares of each cell cover the grid once.
std::string CompleteGuide(Guide& guide);

}  // namespace lanelight
