// A guide from the numbers that it cannot be made without.
#pragma once

#include <span>
#include <string>

#include "src/prepare/guide.h"

namespace lanelight {

/// Completes `guide`, of which nodes, cumulative masses and fractions are set: densities
/// follow. Returns what kernels could not live with, in a few words; empty if nothing:
/// then nodes are a tree of at most kGuideDepth levels whose leaves name cells, and every
/// square of a cell has a positive mass.
std::string CompleteGuide(Guide& guide);

}  // namespace lanelight
