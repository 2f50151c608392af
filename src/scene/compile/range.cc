#include "src/scene/compile/focus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/base/core/error.h"
#include "src/base/core/motion_record.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

bool IsInRange(Vec3d p) {
  const Vec3d a = Max(p, -p);
  return a.x <= kFarthestInScene && a.y <= kFarthestInScene && a.z <= kFarthestInScene;
}

void NoteSmall(const SourceLocation& where, const char* what, Index area_light,
               std::vector<Note>& notes) {
  std::string message = fmt::format(
      "left out this {}: it is less than {:.1g} times as large as the scene, so it would "
      "not be visible",
      what, kSmallestInScene);
  if (area_light != kNone) message += "; this area light emits nothing";
  notes.push_back({where, message});
}

// Returns whether a sphere or disk has a positive size in float32.
bool HasSize(const PlacedShape& placed, double scale) {
  const Shape& shape = *placed.shape;
  const double unit = Length(placed.transform.Vector({1, 0, 0})) * scale;
  const auto radius = static_cast<float>(shape.radius * unit);
  if (shape.kind == ShapeKind::kSphere) return radius >= kSmallestInScene;
  const auto hole = static_cast<float>(shape.inner_radius * unit);
  return double(radius - hole) * double(radius + hole) >=
         kSmallestInScene * kSmallestInScene;
}

void DropTooSmall(const char* what, double scale, std::vector<PlacedShape>& shapes,
                  std::vector<Note>& notes) {
  std::erase_if(shapes, [&](const PlacedShape& placed) {
    // A radius that is not positive, and a ring without any width, are refused later.
    const Shape& shape = *placed.shape;
    if (HasSize(placed, scale) || !(shape.radius > shape.inner_radius)) return false;
    NoteSmall(placed.shape->where, what, placed.area_light, notes);
    return true;
  });
}

// Returns whether the map of rays into the object of an instance is finite in float32.
bool CanBeEntered(const PlacedInstance& instance, const Placement& placement) {
  const WorldFrame& object = placement.objects[instance.object].frame;
  const auto can = [&](const Transform& world_from_object) {
    const Transform object_from_scene =
        placement.frame.After(world_from_object * object.Inverse()).Inverse();
    for (int column = 0; column < 4; ++column) {
      if (!IsInRange({object_from_scene(0, column), object_from_scene(1, column),
                      object_from_scene(2, column)})) {
        return false;
      }
    }
    return true;
  };
  return can(instance.world_from_object) && (!instance.end || can(*instance.end));
}

// A motion is stored in float32, which may flatten what is much thinner in one direction
// than in another.
void CheckMotion(const PlacedInstance& instance, const Placement& placement) {
  if (!instance.end) return;
  const WorldFrame& object = placement.objects[instance.object].frame;
  const Motion motion(instance.world_from_object, *instance.end);
  const Motion stored = MotionOf(RecordOf(InFrames(motion, placement.frame, object)));
  if (stored.At(0).IsInvertible() && stored.At(1).IsInvertible()) return;
  throw InputError(instance.where,
                   "the transform at the start or the end of the motion scales the axes "
                   "too differently for float32: bring the scales closer together");
}

}  // namespace

void RequireInScene(Vec3d p, const SourceLocation& where, const char* what) {
  if (IsInRange(p)) return;
  const Vec3d a = Max(p, -p);
  throw InputError(where, fmt::format("this {} is {:.2g} scene sizes away; up to {:.2g} "
                                      "is supported: move it nearer{}",
                                      what, std::max({a.x, a.y, a.z}), kFarthestInScene,
                                      std::string_view(what) == "light"
                                          ? ", or use a distant or infinite light"
                                          : ""));
}

void DropTooSmallShapes(Placement& placement, std::vector<Note>& notes) {
  DropTooSmall("sphere", placement.frame.scale, placement.spheres, notes);
  DropTooSmall("disk", placement.frame.scale, placement.disks, notes);
  std::erase_if(placement.instances, [&](const PlacedInstance& instance) {
    CheckMotion(instance, placement);
    if (CanBeEntered(instance, placement)) return false;
    NoteSmall(instance.where, "instance", kNone, notes);
    return true;
  });
}

}  // namespace lanelight
