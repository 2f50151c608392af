// Improves a binary tree by moving subtrees to better places.
#pragma once

#include "src/scene/accel/binary_tree.h"

namespace lanelight {

/// Removes the largest subtrees of a planned tree and inserts each where the sum of the
/// half areas of inner nodes falls most (Bittner, Hapala and Havran 2013). Leaves stay.
/// Positions are searched in parallel and moves are made in sequence (after Meister and
/// Bittner 2018), except those that no longer gain. The result does not depend on the
/// number of threads. Inner nodes keep the number of their items, not their range.
/// Changed nodes are planned anew.
void ReinsertSubtrees(BinaryTree& tree);

}  // namespace lanelight
