#include "src/scene/compile/placement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/base/core/motion.h"
#include "src/base/core/parallel.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/shape_records.h"
#include "src/scene/compile/tessellate.h"
#include "src/scene/compile/textures.h"

namespace lanelight {
namespace {

bool IsMaterial(const SceneDescription& d, const Shape& shape, MaterialKind kind) {
  LL_CHECK_GE(shape.material, 0);
  LL_CHECK_LT(static_cast<std::size_t>(shape.material), d.materials.size());
  return d.materials[static_cast<std::size_t>(shape.material)].kind == kind;
}

void CheckTransform(const Transform& t, const SourceLocation& where, const char* of) {
  if (!t.IsInvertible()) {
    throw InputError(where,
                     fmt::format("the transform of this {} cannot be inverted "
                                 "(a scale of zero, or numbers out of range); only "
                                 "invertible transforms are supported",
                                 of));
  }
  if (t(3, 0) != 0 || t(3, 1) != 0 || t(3, 2) != 0 || t(3, 3) != 1) {
    throw InputError(where,
                     fmt::format("the transform of this {} is projective (last row "
                                 "{} {} {} {}); only affine transforms are "
                                 "supported",
                                 of, t(3, 0), t(3, 1), t(3, 2), t(3, 3)));
  }
}

Index EmittingLight(const SceneDescription& d, const Shape& shape) {
  if (shape.area_light == kNone) return kNone;
  LL_CHECK_LT(static_cast<std::size_t>(shape.area_light), d.area_lights.size());
  const auto& light = d.area_lights[static_cast<std::size_t>(shape.area_light)];
  return Emits(light) ? shape.area_light : kNone;
}

void CheckEmitter(const SceneDescription& d, const Shape& shape) {
  const SourceLocation& where = shape.where;
  if (IsMaterial(d, shape, MaterialKind::kInterface)) {
    throw InputError(where,
                     "an area light on a shape with material \"interface\" is not "
                     "supported; give the shape another material (a diffuse one with "
                     "reflectance 0 emits and does not scatter)");
  }
  if (shape.kind == ShapeKind::kPlane) {
    throw InputError(where,
                     "an infinite plane cannot be an area light; supported are "
                     "all other shapes");
  }
}

// Sets the mesh of a mesh or of a tessellated shape.
void SetMesh(double tolerance, PlacedShape* placed) {
  const Shape& shape = *placed->shape;
  if (shape.kind == ShapeKind::kMesh) placed->mesh = shape.mesh;
  if (!IsTessellated(shape, placed->transform)) return;
  placed->mesh = std::make_shared<const TriangleMesh>(Tessellate(shape, tolerance));
}

// Sets a mesh for any shape of an object, tessellated if it is round.
void SetMeshInObject(PlacedShape* placed) {
  SetMesh(kOfObjects, placed);
  if (placed->mesh != nullptr) return;
  placed->mesh =
      std::make_shared<const TriangleMesh>(Tessellate(*placed->shape, kOfObjects));
}

// Returns the shape as it will be compiled, or nothing if it is invisible.
std::optional<PlacedShape> Place(const SceneDescription& d,
                                 const TextureConstants& constants, const Shape& shape,
                                 const Transform* instance) {
  PlacedShape placed;
  placed.shape = &shape;
  placed.alpha = constants.Fold(shape.alpha);
  placed.area_light = EmittingLight(d, shape);
  if (placed.area_light != kNone) CheckEmitter(d, shape);
  const bool interface = IsMaterial(d, shape, MaterialKind::kInterface);
  if (interface && !shape.media.IsTransition()) return std::nullopt;
  const bool unseen = placed.alpha.texture == kNone && placed.alpha.constant <= 0;
  if (unseen && placed.area_light == kNone) return std::nullopt;
  CheckTransform(shape.world_from_object, shape.where, "shape");
  placed.transform =
      instance ? *instance * shape.world_from_object : shape.world_from_object;
  placed.flip = shape.reverse_orientation != shape.world_from_object.SwapsHandedness();
  return placed;
}

void AddToWorld(const SceneDescription& d, PlacedShape placed, Placement& placement) {
  SetMesh(CameraTolerance(placed, d.camera, d.film), &placed);
  if (placed.mesh != nullptr) return placement.meshes.push_back(placed);
  switch (placed.shape->kind) {
    case ShapeKind::kMesh:
    case ShapeKind::kCylinder:
      LL_CHECK(!"a shape of triangles without a mesh");
      break;
    case ShapeKind::kSphere:
      return placement.spheres.push_back(placed);
    case ShapeKind::kDisk:
      return placement.disks.push_back(placed);
    case ShapeKind::kPlane:
      return placement.planes.push_back(placed);
    case ShapeKind::kCurves:
      return placement.curves.push_back(placed);
  }
}

// `moves` is true for moving objects.
bool StaysInObject(const SceneDescription& d, const Shape& shape, bool moves) {
  const bool is_mesh =
      shape.kind == ShapeKind::kMesh || IsTessellated(shape, shape.world_from_object);
  const bool is_round =
      shape.kind == ShapeKind::kSphere || shape.kind == ShapeKind::kDisk;
  return (is_mesh || (moves && is_round)) && EmittingLight(d, shape) == kNone;
}

// World coordinates and sizes of scenes that can be brought to unit size
// (world_frame.cc): the squares of their lengths and of the scale are ordinary numbers of
// double precision.
constexpr double kFarthest = 1e100, kSmallest = 1e-100;

bool IsTooFar(Vec3d p) {
  const Vec3d a = Max(p, -p);
  return !(a.x <= kFarthest && a.y <= kFarthest && a.z <= kFarthest);
}

[[noreturn]] void ThrowTooFar(const SourceLocation& where, const char* what) {
  throw InputError(where,
                   fmt::format("{} reaches beyond {:g} units from the origin of the "
                               "world, the supported range: scale the scene down",
                               what, kFarthest));
}

// Returns the box of a mesh, or nothing if it reaches too far. Vertices that are not
// finite (of degenerate triangles) and those of no triangle are left out.
std::optional<Box> MeshBox(const PlacedShape& placed) {
  const TriangleMesh& mesh = *placed.mesh;
  // Most vertices are shared by six triangles, and placed once.
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (std::uint32_t i : mesh.indices) {
    LL_CHECK_LT(i, mesh.positions.size());
    used[i] = 1;
  }
  Box box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i] || !IsFinite(mesh.positions[i])) continue;
    const Vec3d p = placed.transform.Point(mesh.positions[i]);
    if (IsTooFar(p)) return std::nullopt;
    box.Add(p);
  }
  return box;
}

Box UnionOfBoxes(const std::vector<PlacedShape>& shapes) {
  std::vector<std::optional<Box>> boxes(shapes.size());
  ParallelFor(shapes.size(), [&](std::size_t i) {
    boxes[i] = shapes[i].mesh ? MeshBox(shapes[i]) : ShapeBox(shapes[i]);
  });
  Box all;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::optional<Box>& box = boxes[i];
    if (!box || (!box->empty() && (IsTooFar(box->min) || IsTooFar(box->max)))) {
      ThrowTooFar(shapes[i].shape->where, "this shape");
    }
    all.Add(*box);
  }
  return all;
}

// Returns a box for scenes of infinite planes only, from the camera and its distance to
// them.
Box FallbackBox(const SceneDescription& d, const Placement& placement) {
  Box box;
  const Vec3d eye = d.camera.world_from_camera.Point({0, 0, 0});
  box.Add(eye);
  for (const Light& light : d.lights) {
    if (light.kind != LightKind::kPoint && light.kind != LightKind::kSpot) continue;
    box.Add(light.world_from_light.Point(light.from));
  }
  for (const PlacedShape& plane : placement.planes) {
    const Vec3d n = Normalize(plane.transform.Normal({0, 0, 1}));
    box.Add(eye - n * Dot(eye - plane.transform.Point({0, 0, 0}), n));
  }
  return box;
}

// An object definition: how often it is placed, and what of it can be instanced.
struct ObjectUse {
  std::uint64_t count = 0;
  bool moves = false;
  PlacedObject placed;
  bool copied = false;
  std::size_t index = 0;  // in Placement::objects, unless it is copied or empty

  // Returns the number of triangles that copies add to the scene.
  std::uint64_t MoreTriangles() const {
    std::uint64_t indices = 0;
    for (const PlacedShape& p : placed.meshes) indices += p.mesh->indices.size();
    return (count - 1) * (indices / 3);
  }
};

// Places the shapes of an instance that cannot stay in its object, or all if it is
// copied.
void CopyIntoWorld(const SceneDescription& d, const TextureConstants& constants,
                   const Instance& instance, const ObjectUse& use, Placement& placement) {
  for (const Shape& shape : d.objects[static_cast<std::size_t>(instance.object)].shapes) {
    if (!use.copied && StaysInObject(d, shape, use.moves)) continue;
    if (const auto p = Place(d, constants, shape, &instance.world_from_object)) {
      AddToWorld(d, *p, placement);
    }
  }
}

PlacedObject PlaceObject(const SceneDescription& d, const TextureConstants& constants,
                         const ObjectDefinition& object, bool moves) {
  PlacedObject placed;
  for (const Shape& shape : object.shapes) {
    if (!StaysInObject(d, shape, moves)) continue;
    if (auto p = Place(d, constants, shape, nullptr)) {
      SetMeshInObject(&*p);
      placed.meshes.push_back(*p);
    }
  }
  placed.bounds = UnionOfBoxes(placed.meshes);
  placed.frame = FrameOf(placed.bounds);
  return placed;
}

std::vector<ObjectUse> PlaceObjects(const SceneDescription& d,
                                    const TextureConstants& constants) {
  std::vector<ObjectUse> uses(d.objects.size());
  for (const Instance& instance : d.instances) {
    LL_CHECK_GE(instance.object, 0);
    LL_CHECK_LT(static_cast<std::size_t>(instance.object), d.objects.size());
    CheckTransform(instance.world_from_object, instance.where, "instance");
    ObjectUse& use = uses[static_cast<std::size_t>(instance.object)];
    ++use.count;
    if (instance.end == nullptr) continue;
    CheckTransform(*instance.end, instance.where, "instance");
    use.moves = true;
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    ObjectUse& use = uses[i];
    if (use.count > 0) use.placed = PlaceObject(d, constants, d.objects[i], use.moves);
  }
  return uses;
}

// Rays need maps for each instance that they come near; triangles in the world need
// memory.
void ChooseCopied(std::uint64_t max_copies, std::vector<ObjectUse>& uses) {
  if (max_copies == 0) return;
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i].count == 0 || uses[i].moves) continue;
    order.emplace_back(uses[i].MoreTriangles(), i);
  }
  std::ranges::sort(order);
  for (const auto& [more, i] : order) {
    if (more > max_copies) return;
    max_copies -= more;
    uses[i].copied = true;
  }
}

// Returns the world-space box of an instance during its whole motion.
Box BoxOf(const Instance& instance, const Box& object) {
  if (instance.end == nullptr) return object.Transformed(instance.world_from_object);
  const Motion motion(instance.world_from_object, *instance.end);
  Box box;
  for (int i = 0; i <= motion.Parts(); ++i) {
    const double s = static_cast<double>(i) / motion.Parts();
    box.Add(object.Transformed(motion.At(s)));
  }
  const Vec3d far = Max(Max(object.max, -object.max), Max(object.min, -object.min));
  const double by = motion.Deviation(std::max({far.x, far.y, far.z}));
  box.min = box.min - Vec3d{by, by, by};
  box.max = box.max + Vec3d{by, by, by};
  return box;
}

void PlaceInstances(const SceneDescription& d, const TextureConstants& constants,
                    std::uint64_t copied_triangles, Placement& placement) {
  std::vector<ObjectUse> uses = PlaceObjects(d, constants);
  ChooseCopied(copied_triangles, uses);
  for (ObjectUse& use : uses) {
    if (use.copied || use.placed.bounds.empty()) continue;
    use.index = placement.objects.size();
    placement.objects.push_back(use.placed);
  }
  std::vector<PlacedInstance> still;
  for (const Instance& instance : d.instances) {
    const ObjectUse& use = uses[static_cast<std::size_t>(instance.object)];
    CopyIntoWorld(d, constants, instance, use, placement);
    if (use.placed.bounds.empty()) continue;
    const Box box = BoxOf(instance, use.placed.bounds);
    if (box.empty() || IsTooFar(box.min) || IsTooFar(box.max)) {
      ThrowTooFar(instance.where, "this instance");
    }
    if (use.copied) continue;  // the bounds of its copies are tighter
    (instance.end ? placement.instances : still)
        .push_back(
            {use.index, instance.world_from_object, instance.where, instance.end, box});
    placement.bounds.Add(box);
  }
  auto& placed = placement.instances;
  if (placed.empty()) return placed.swap(still);
  placed.insert(placed.end(), still.begin(), still.end());
}

void CheckSize(const SceneDescription& d, const Box& bounds) {
  const double size = bounds.HalfDiagonal();
  if (bounds.empty() || size == 0 || size >= kSmallest || d.shapes.empty()) return;
  throw InputError(
      d.shapes.front().where,
      fmt::format("all shapes together are {:g} units large; {:g} to {:g} are supported: "
                  "scale the scene up",
                  size, kSmallest, kFarthest));
}

}  // namespace

Box ShapeBox(const PlacedShape& placed) {
  const Shape& shape = *placed.shape;
  Box box;
  if (placed.mesh != nullptr) return MeshBox(placed).value_or(box);
  if (shape.kind == ShapeKind::kPlane) return box;
  if (shape.kind == ShapeKind::kCurves) return CurveBox(shape, placed.transform);
  const double r = shape.radius;
  const double z = shape.kind == ShapeKind::kSphere ? r : 0;
  const double h = shape.kind == ShapeKind::kSphere ? 0 : shape.height;
  box.Add(Vec3d{-r, -r, h - z});
  box.Add(Vec3d{r, r, h + z});
  // The box of the box: larger than need be, but its centre is exact.
  return box.Transformed(placed.transform);
}

bool Emits(const AreaLight& light) {
  const Rgb l = light.radiance * light.scale;
  return l.x > 0 || l.y > 0 || l.z > 0;
}

Placement PlaceShapes(const SceneDescription& d, std::uint64_t copied_triangles) {
  const TextureConstants constants(d.textures);
  Placement placement;
  for (const Shape& shape : d.shapes) {
    if (const auto p = Place(d, constants, shape, nullptr)) AddToWorld(d, *p, placement);
  }
  PlaceInstances(d, constants, copied_triangles, placement);
  for (const auto* shapes :
       {&placement.meshes, &placement.spheres, &placement.disks, &placement.curves}) {
    placement.bounds.Add(UnionOfBoxes(*shapes));
  }
  if (placement.bounds.empty()) placement.bounds = FallbackBox(d, placement);
  CheckSize(d, placement.bounds);
  placement.eye = d.camera.world_from_camera.Point({0, 0, 0});
  SeparateLargeSpheres(placement);
  placement.frame = FocusFrame(placement);
  return placement;
}

}  // namespace lanelight
