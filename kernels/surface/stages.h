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
// What is made of that before materials are looked up.
Stage FootprintsStage();
Stage BumpsStage();
Stage NormalMapsStage();

/// What every surface stage writes (where the columns exist).
inline FieldSet SurfaceFields() {
  return fields::kPoint | fields::kNormal | fields::kTangents | fields::kUv |
         FieldSet{Field::material};
}

/// What stages that give a surface another shading normal read and write.
inline FieldSet ReliefReads() {
  return fields::kNormal | fields::kTangents | fields::kUv |
         FieldSet{Field::d_x, Field::d_y, Field::d_z, Field::material};
}
inline FieldSet ReliefWrites() {
  return fields::kTangent | FieldSet{Field::ns_x, Field::ns_y, Field::ns_z};
}

}  // namespace lanelight
