// Decides which shapes a scene has and where. Invisible shapes are left out, instances of
// shapes without an instanced form are copied into the world, and what cannot be
// represented is an InputError at its directive.
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

/// Places shapes. Emitting meshes, spheres and disks are sampled as lights, which needs
/// world coordinates; spheres, disks, planes and curves have no instanced form. Both are
/// copied into the world once per instance. Shapes without a record become meshes
/// (src/scene/compile/tessellate.h). Objects of few triangles, or placed once, are copied
/// too, smallest first, while that adds at most `copied_triangles` in all (0: none).
/// Moving objects are not copied: their shapes become meshes, except curves and planes,
/// which stay at the start.
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

/// Returns the bounds of a shape, empty if it has none; the centre is exact.
Box ShapeBox(const PlacedShape& placed);

/// Returns whether some component of the light's radiance is positive.
bool Emits(const AreaLight& light);

}  // namespace lanelight
