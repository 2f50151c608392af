#include "src/scene/compile/shape_records.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/error.h"
#include "src/scene/compile/focus.h"
#include "src/scene/compile/world_frame.h"

namespace lanelight {
namespace {

template <typename Record>
Record MakeRecord(const PlacedShape& placed, std::uint32_t material) {
  Record record{};
  record.material = material;
  record.light = -1;
  record.flags = IsAlphaTested(placed) ? kAlphaTested : 0;
  return record;
}

void CheckRadius(const Shape& shape, const char* kind) {
  if (shape.radius > 0 && std::isfinite(shape.radius)) return;
  throw InputError(
      shape.where,
      fmt::format("{} of radius {}; the radius must be positive", kind, shape.radius));
}

}  // namespace

bool IsAlphaTested(const PlacedShape& placed) {
  return placed.alpha.texture != kNone || placed.alpha.constant < 1;
}

SphereRecord CompileSphere(const PlacedShape& placed, const WorldFrame& frame,
                           std::uint32_t material) {
  const Shape& shape = *placed.shape;
  CheckRadius(shape, "a sphere");
  const Transform t = frame.After(placed.transform);
  const double s = t.UniformScale();
  LL_CHECK_GT(s, 0);  // else it is tessellated
  auto record = MakeRecord<SphereRecord>(placed, material);
  Store(t.Point({0, 0, 0}), record.center);
  record.radius = static_cast<float>(shape.radius * s);
  record.normal_sign = placed.flip ? -1.0f : 1.0f;
  Store(Normalize(t.Vector({1, 0, 0})), record.x_axis);
  Store(Normalize(t.Vector({0, 0, 1})), record.z_axis);
  record.y_sign = t.SwapsHandedness() ? -1.0f : 1.0f;
  return record;
}

LargeSphereRecord CompileLargeSphere(const PlacedShape& placed, const WorldFrame& frame,
                                     Vec3d eye, std::uint32_t material) {
  const SphereRecord sphere = CompileSphere(placed, frame, material);
  const Vec3d center = placed.transform.Point({0, 0, 0});
  const double radius = placed.shape->radius * placed.transform.UniformScale();
  const NearestPoint foot = NearestPointOn(center, radius, eye);
  auto record = MakeRecord<LargeSphereRecord>(placed, material);
  Store(frame.Point(foot.point), record.point);
  Store((foot.point - center) / radius, record.normal);
  record.curvature = static_cast<float>(1 / (radius * frame.scale));
  record.normal_sign = sphere.normal_sign;
  std::ranges::copy(sphere.x_axis, record.x_axis);
  std::ranges::copy(sphere.z_axis, record.z_axis);
  record.y_sign = sphere.y_sign;
  return record;
}

DiskRecord CompileDisk(const PlacedShape& placed, const WorldFrame& frame,
                       std::uint32_t material) {
  const Shape& shape = *placed.shape;
  CheckRadius(shape, "a disk");
  if (!(shape.inner_radius >= 0 && shape.inner_radius < shape.radius)) {
    throw InputError(shape.where,
                     fmt::format("a disk of inner radius {}; it must be at least 0 and "
                                 "less than the radius {}",
                                 shape.inner_radius, shape.radius));
  }
  const Transform t = frame.After(placed.transform);
  const Vec3d x = t.Vector({1, 0, 0}), y = t.Vector({0, 1, 0});
  const double s = Length(x);
  const Vec3d n = Normalize(t.Normal({0, 0, 1})) * (placed.flip ? -1.0 : 1.0);
  auto record = MakeRecord<DiskRecord>(placed, material);
  Store(t.Point({0, 0, shape.height}), record.center);
  record.radius = static_cast<float>(shape.radius * s);
  record.inner_radius = static_cast<float>(shape.inner_radius * s);
  Store(n, record.normal);
  Store(x / s, record.u_axis);
  record.v_sign = Dot(Cross(n, x), y) < 0 ? -1.0f : 1.0f;
  return record;
}

PlaneRecord CompilePlane(const PlacedShape& placed, const WorldFrame& frame,
                         std::uint32_t material, bool keep_uv) {
  const Transform t = frame.After(placed.transform);
  const Vec3d x = t.Vector({1, 0, 0}), y = t.Vector({0, 1, 0});
  const Vec3d n = Normalize(t.Normal({0, 0, 1})) * (placed.flip ? -1.0 : 1.0);
  const Vec3d origin = t.Point({0, 0, 0});
  const Vec3d point = keep_uv ? origin : n * Dot(origin, n);
  RequireInScene(point, placed.shape->where, "plane");
  // Dual basis within the plane: dot(a x + b y, u) = a, dot(a x + b y, v) = b.
  const Vec3d across_y = Cross(y, n), across_x = Cross(n, x);
  auto record = MakeRecord<PlaneRecord>(placed, material);
  Store(point, record.point);
  Store(n, record.normal);
  Store(across_y / Dot(across_y, x), record.u_axis);
  Store(across_x / Dot(across_x, y), record.v_axis);
  return record;
}

}  // namespace lanelight
