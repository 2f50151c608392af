// The tree over the instances of a scene.
#pragma once

#include <vector>

#include "src/scene/accel/builder.h"
#include "src/scene/geometry/geometry.h"

namespace lanelight {

/// Appends its nodes to `nodes`. `group_boxes` bound the triangles of each group,
/// `groups` are their trees. The depth of the result counts the nodes below instances
/// too.
Bvh BuildTop(const Geometry& geometry, const std::vector<AccelBox>& group_boxes,
             const std::vector<Bvh>& groups, AlignedVector<WideNode>& nodes);

}  // namespace lanelight
