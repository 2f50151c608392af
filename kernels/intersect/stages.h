// Factories of the intersect stages, and what they have in common.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

// Closest hit: input kActive; t is an upper bound on input (+inf at first) and is
// lowered, with prim, b1, b2 and inst, where a nearer hit is found. Equal distances go to
// the smaller primitive id.
Stage IntersectTrianglesStage();
Stage IntersectSpheresStage();
Stage IntersectDisksStage();
Stage IntersectPlanesStage();
Stage IntersectLargeSpheresStage();

// Any hit: input kShadow; blocked paths leave the queue, the others keep their order.
Stage ShadowTrianglesStage();
Stage ShadowSpheresStage();
Stage ShadowDisksStage();
Stage ShadowPlanesStage();
Stage ShadowLargeSpheresStage();

/// What a closest-hit query is made of. Where t is still +inf there is no hit yet, and
/// prim is the primitive that the ray starts on (kNoPrimitive: none), which triangles
/// leave out.
inline FieldSet ClosestRayFields() { return fields::kRay | FieldSet{Field::t}; }

/// What a shadow ray is made of: its offset origin, direction and length.
inline FieldSet ShadowRayFields() {
  return fields::kPoint | FieldSet{Field::ng_x,       Field::ng_y, Field::ng_z,
                                   Field::ls_x,       Field::ls_y, Field::ls_z,
                                   Field::ls_distance};
}

}  // namespace lanelight
