// Improves a binary tree by moving subtrees to better places.
#pragma once

#include "src/scene/accel/binary_tree.h"

namespace lanelight {

/// Takes the largest subtrees out of a planned tree and puts each where the sum of the
/// half areas of all inner nodes falls most, if there is such a place: what a division
/// from the top down cannot see (Bittner, Hapala and Havran 2013). Leaves stay as they
/// are. Places are searched in parallel and moves made one after the other (after Meister
/// and Bittner 2018), those that gain nothing any more left out; the result does not
/// depend on the number of threads. Inner nodes keep the number of their items, not their
/// range; what has changed is planned anew.
void ReinsertSubtrees(BinaryTree& tree);

}  // namespace lanelight
