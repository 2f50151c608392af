// From binary to wide nodes at the least expected cost.
#pragma once

#include <cstdint>
#include <vector>

#include "src/scene/accel/binary_tree.h"
#include "src/scene/accel/builder.h"

namespace lanelight {

/// Fills `cost`, `left` and, above leaves, `area` of `node`, whose subtree is complete
/// and whose children are planned. A ray meets a node with a probability proportional to
/// its surface, so the cost of a forest is the sum of half areas times kWideNodeCost or
/// kLeafCost. The best forest of at most i trees under a node combines forests of k and i
/// - k trees under its children. One tree is a wide node over the best forest of 8
/// (Ylitie, Karras and Laine 2017, section 3.1).
void PlanCollapse(BinaryTree& tree, std::uint32_t node);

/// Appends the planned tree to `nodes`, and its leaves to `leaves`. `single`: leaf
/// references are the ids of items, of which leaves hold one each.
Bvh Collapse(const BinaryTree& tree, const std::vector<BuildItem>& items, bool single,
             AlignedVector<WideNode>& nodes, std::vector<LeafRange>& leaves);

}  // namespace lanelight
