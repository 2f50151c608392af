// Which shapes a scene really has and where they stand: shapes that cannot be seen are
// left out, instances of what cannot be instanced are copied into the world, and what the
// renderer cannot represent is an InputError at the directive that asked for it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "src/scene/compile/world_frame.h"
#include "src/scene/description/description.h"

namespace lanelight {

/// A shape and the coordinates it is compiled into (the world, or those of its object).
struct PlacedShape {
  const Shape* shape = nullptr;
  std::shared_ptr<const TriangleMesh> mesh;  // of the shape, or in its place; or null
  Transform transform;                       // those coordinates from the shape's own
  bool flip = false;           // quadrics: the normal is turned round (see below)
  Index area_light = kNone;    // only if it emits anything
  FloatValue alpha{1, kNone};  // constant textures folded
};

/// Meshes of an object definition that is instanced, in object coordinates; those that
/// stand for other shapes (src/scene/compile/tessellate.h) too.
struct PlacedObject {
  std::vector<PlacedShape> meshes;
  Box bounds;
  WorldFrame frame;  // of those bounds
};

struct PlacedInstance {
  std::size_t object = 0;  // index into Placement::objects
  Transform world_from_object;
  SourceLocation where;
  EndTransform end;  // as in Instance
  Box bounds;        // in the world, of all the way that it moves
};

// Orientation. For quadrics pbrt-v4 turns the parametric normal round if
// ReverseOrientation XOR the shape's own transform mirrors; the transform of an instance
// carries that normal along and never turns it. Hence `flip` is decided by the shape's
// own transform, also for copies made of instanced shapes. (For meshes see
// src/scene/compile/geometry.h: there only the product of the transforms matters.)
struct Placement {
  // In the world. Large spheres: see src/scene/compile/focus.h.
  std::vector<PlacedShape> meshes, spheres, disks, planes, large_spheres, curves;
  std::vector<PlacedObject> objects;
  std::vector<PlacedInstance> instances;  // those that move first
  Vec3d eye;                              // the camera's position in the world
  WorldFrame frame;                       // of the scene
  Box bounds;  // of the finite geometry in the world; if there is none, of the camera,
               // the lights with a position, and the camera's foot on each plane
};

/// Meshes, spheres and disks that emit are sampled as lights, which needs world
/// coordinates; spheres, disks, planes and curves have no instanced form: both kinds are
/// copied into the world once per instance. Shapes without a record of their own become
/// meshes (src/scene/compile/tessellate.h). Objects of few triangles, or placed once, are
/// copied into the world too, those first that make the least of it larger, as long as
/// that makes at most `copied_triangles` more in all; with 0 none is. Of objects that
/// move nothing is copied: what they are made of becomes meshes, but for curves and
/// planes, which stay where they are at the start.
Placement PlaceShapes(const SceneDescription& description,
                      std::uint64_t copied_triangles = 0);

/// Calls visit(placed) for everything placed, the world's meshes first.
template <typename Visit>
void ForEachPlaced(const Placement& placement, const Visit& visit) {
  for (const PlacedShape& mesh : placement.meshes) visit(mesh);
  for (const PlacedObject& object : placement.objects) {
    for (const PlacedShape& mesh : object.meshes) visit(mesh);
  }
  for (const auto* shapes : {&placement.spheres, &placement.disks, &placement.planes,
                             &placement.large_spheres, &placement.curves}) {
    for (const PlacedShape& shape : *shapes) visit(shape);
  }
}

/// Bounds of a shape, or nothing if it has none; the centre is exact.
Box ShapeBox(const PlacedShape& placed);

/// True if the light emits: some component of its radiance is positive.
bool Emits(const AreaLight& light);

}  // namespace lanelight
