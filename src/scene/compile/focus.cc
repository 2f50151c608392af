#include "src/scene/compile/focus.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"

namespace lanelight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Meshes are known by their boxes and vertices only: only where a vertex is this much
// nearer than the mesh is large does the camera look at a small part of it.
constexpr double kMeshRange = 4096;
// Frame coordinates stay below this, so that their cubes do not overflow.
constexpr double kLargestCoordinate = 0x1p30;

// A shape as the camera sees it: its distance, and the position of its relevant part.
struct ShapeInView {
  double reach;
  Box box;
};

double Farthest(const Box& box, Vec3d eye) {
  const Vec3d a = eye - box.min, b = box.max - eye;
  return std::hypot(std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z));
}

double RadiusOf(const PlacedShape& sphere) {
  return sphere.shape->radius * sphere.transform.UniformScale();
}

NearestPoint FootOf(const PlacedShape& sphere, Vec3d eye) {
  return NearestPointOn(sphere.transform.Point({0, 0, 0}), RadiusOf(sphere), eye);
}

bool IsLarge(const PlacedShape& sphere, const NearestPoint& foot) {
  return foot.distance * kFocusRange < RadiusOf(sphere);
}

// A large sphere is seen as its nearest point.
ShapeInView SphereInView(const PlacedShape& placed, const Box& box, Vec3d eye) {
  const NearestPoint foot = FootOf(placed, eye);
  if (!IsLarge(placed, foot)) return {Farthest(box, eye), box};
  ShapeInView seen{foot.distance, {}};
  seen.box.Add(foot.point);
  return seen;
}

// A mesh close to the camera is likewise reduced to its nearest vertex.
ShapeInView MeshInView(const PlacedShape& placed, const Box& box, Vec3d eye) {
  const double reach = Farthest(box, eye);
  const Vec3d outside = Max(Max(box.min - eye, eye - box.max), {});
  if (!(Length(outside) * kMeshRange < reach)) return {reach, box};
  ShapeInView near{kInfinity, {}};
  Vec3d nearest;
  for (const Vec3d& vertex : placed.mesh->positions) {
    const Vec3d p = placed.transform.Point(vertex);
    const double distance = Length(p - eye);
    // A camera on a shape's surface sees nothing of that shape.
    if (distance < reach * 0x1p-24) continue;
    if (distance < near.reach) near.reach = distance, nearest = p;
  }
  if (!(near.reach * kMeshRange < reach)) return {reach, box};
  near.box.Add(nearest);
  return near;
}

std::vector<ShapeInView> ShapesInView(Vec3d eye, const Placement& p) {
  std::vector<ShapeInView> all, meshes(p.meshes.size());
  const auto add = [&](const ShapeInView& seen) {
    if (!seen.box.empty() && std::isfinite(seen.reach)) all.push_back(seen);
  };
  for (const auto* spheres : {&p.spheres, &p.large_spheres}) {
    for (const PlacedShape& s : *spheres) add(SphereInView(s, ShapeBox(s), eye));
  }
  for (const auto* shapes : {&p.disks, &p.curves}) {
    for (const PlacedShape& shape : *shapes) {
      const Box box = ShapeBox(shape);
      add({Farthest(box, eye), box});
    }
  }
  ParallelFor(p.meshes.size(), [&](std::size_t i) {
    meshes[i] = MeshInView(p.meshes[i], ShapeBox(p.meshes[i]), eye);
  });
  for (const ShapeInView& mesh : meshes) add(mesh);
  for (const PlacedInstance& instance : p.instances) {
    add({Farthest(instance.bounds, eye), instance.bounds});
  }
  std::ranges::sort(
      all, [](const ShapeInView& a, const ShapeInView& b) { return a.reach < b.reach; });
  return all;
}

// The shapes up to the first gap in their distances.
Box NearPart(const std::vector<ShapeInView>& all) {
  Box box;
  double reach = 0;
  for (const ShapeInView& seen : all) {
    if (reach > 0 && seen.reach > kFocusRange * reach) break;
    reach = std::max(seen.reach, reach);
    box.Add(seen.box);
  }
  return box;
}

}  // namespace

NearestPoint NearestPointOn(Vec3d center, double radius, Vec3d eye) {
  const Vec3d out = eye - center;
  const double length = std::hypot(out.x, out.y, out.z);
  const Vec3d n = length > 0 ? out / length : Vec3d{0, 0, 1};
  return {center + radius * n, std::abs(length - radius)};
}

void SeparateLargeSpheres(Placement& placement) {
  std::vector<PlacedShape> kept;
  for (PlacedShape& sphere : placement.spheres) {
    const bool large =
        sphere.area_light == kNone && IsLarge(sphere, FootOf(sphere, placement.eye));
    (large ? placement.large_spheres : kept).push_back(std::move(sphere));
  }
  placement.spheres = std::move(kept);
}

void NoteLargeEmitters(const Placement& placement, std::vector<Note>& notes) {
  for (const PlacedShape& placed : placement.spheres) {
    const double radius = RadiusOf(placed);
    const NearestPoint foot = FootOf(placed, placement.eye);
    if (!(foot.distance * kMaxEmitterRange < radius)) continue;
    notes.push_back(
        {placed.shape->where,
         fmt::format(
             "the radius of an emitting sphere is {:.2g} times the camera's distance to "
             "it: rounding moves its surface by up to {:.2g} of that distance; use a "
             "disk or a mesh for the near part if the factor exceeds {:.0e}",
             radius / foot.distance, radius / foot.distance * 0x1p-22,
             kMaxEmitterRange)});
  }
}

WorldFrame FocusFrame(const Placement& placement) {
  const Vec3d eye = placement.eye;
  const std::vector<ShapeInView> all = ShapesInView(eye, placement);
  const Box near = NearPart(all);
  if (near.empty()) return FrameOf(placement.bounds);
  const double size = placement.bounds.HalfDiagonal();
  const double reach = Length(near.Center() - eye);
  const double detail =
      std::max({near.HalfDiagonal(), std::min(reach, size), size / kLargestCoordinate});
  if (!(detail * kFocusRange < size)) return FrameOf(placement.bounds);
  // A box about the near part's centre, of the size that gives the scale.
  Box about;
  about.Add(near.Center());
  WorldFrame frame = FrameOf(about);
  int exponent = 0;
  std::frexp(detail, &exponent);
  frame.scale = std::ldexp(1.0, 1 - exponent);
  return frame;
}

}  // namespace lanelight
