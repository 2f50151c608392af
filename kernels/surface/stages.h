// Factories of the surface stages: the hit point with its error bound, normals, tangent,
// surface coordinates and material of the hits in kSurface.
#pragma once

#include "src/path/stage.h"

namespace lanelight {

Stage SurfaceTriangleStage();
Stage SurfaceSphereStage();
Stage SurfaceDiskStage();
Stage SurfacePlaneStage();
Stage SurfaceLargeSphereStage();

/// What every surface stage writes (where the columns exist).
inline FieldSet SurfaceFields() {
  return fields::kPoint | fields::kNormal | fields::kTangent | fields::kUv |
         FieldSet{Field::material};
}

}  // namespace lanelight
