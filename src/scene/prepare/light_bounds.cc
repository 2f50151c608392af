#include "src/scene/prepare/light_bounds.h"

#include "src/base/core/pi.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

// Returns the smallest cone around two cones (Conty Estevez and Kulla 2018, algorithm 1).
Cone Union(const Cone& a, const Cone& b) {
  if (a.angle < 0) return b;
  if (b.angle < 0) return a;
  const Cone& wide = a.angle >= b.angle ? a : b;
  const Cone& narrow = a.angle >= b.angle ? b : a;
  const double between = std::acos(std::clamp(Dot(wide.axis, narrow.axis), -1.0, 1.0));
  if (std::min(between + narrow.angle, kPi) <= wide.angle) return wide;
  const double angle = (wide.angle + between + narrow.angle) / 2;
  const Vec3d across = Cross(wide.axis, narrow.axis);
  if (angle >= kPi || !(Length(across) > 1e-12)) return {wide.axis, kPi};
  // Turn the wide axis towards the narrow one.
  const Vec3d side = Normalize(Cross(across, wide.axis));
  const double turn = angle - wide.angle;
  return {std::cos(turn) * wide.axis + std::sin(turn) * side, angle};
}

}  // namespace

void LightBounds::Add(Vec3d p) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], p[k]);
    high[k] = std::max(high[k], p[k]);
  }
}

void LightBounds::Add(const LightBounds& o) {
  if (!(o.power > 0)) return;
  Add(o.low);
  Add(o.high);
  cone = Union(cone, o.cone);
  power += o.power;
}

double LightBounds::Area() const {
  const Vec3d d = high - low;
  return 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
}

double LightBounds::Orientation() const {
  const double o = cone.angle, w = std::min(o + kPi / 2, kPi);
  const double beyond =
      2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o);
  return 2 * kPi * (1 - std::cos(o)) + kPi / 2 * beyond;
}

bool HasPlace(const LightRecord& light) {
  return !HasTrait(static_cast<LightShape>(light.shape), kFarLight);
}

LightBounds BoundsOf(const Geometry& g, const LightRecord& light) {
  LightBounds b;
  b.cone = {{0, 0, 1}, kPi};
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kTriangle: {
      const TriangleRecord& t = g.triangles[light.primitive];
      for (const auto& p : t.p) b.Add(ToVec(p));
      const Vec3d n = Cross(ToVec(t.p[1]) - ToVec(t.p[0]), ToVec(t.p[2]) - ToVec(t.p[0]));
      if (!light.two_sided) b.cone = {Normalize(n), 0};
      break;
    }
    case LightShape::kRectangle: {
      for (const std::uint32_t prim : {light.primitive, light.second_primitive}) {
        for (const auto& p : g.triangles[prim].p) b.Add(ToVec(p));
      }
      const Vec3d n = Cross(ToVec(light.direction), ToVec(light.side));
      if (!light.two_sided) b.cone = {Normalize(n), 0};
      break;
    }
    case LightShape::kSphere: {
      const SphereRecord& s = g.spheres[light.primitive - g.ranges.spheres];
      const double r = s.radius;
      b.Add(ToVec(s.center) - Vec3d{r, r, r});
      b.Add(ToVec(s.center) + Vec3d{r, r, r});
      break;
    }
    case LightShape::kDisk: {
      const DiskRecord& d = g.disks[light.primitive - g.ranges.disks];
      const Vec3d n = ToVec(d.normal);
      Vec3d extent;
      for (int k = 0; k < 3; ++k) {
        extent[k] = d.radius * std::sqrt(std::max(0.0, 1 - n[k] * n[k]));
      }
      b.Add(ToVec(d.center) - extent);
      b.Add(ToVec(d.center) + extent);
      if (!light.two_sided) b.cone = {Normalize(n), 0};
      break;
    }
    case LightShape::kProjection:
    case LightShape::kSpot: {
      b.Add(ToVec(light.position));
      const double width =
          2 * std::asin(std::sqrt(std::clamp(light.size[0] / 2.0, 0.0, 1.0)));
      b.cone = {Normalize(ToVec(light.direction)), std::max(0.0, width - kPi / 2)};
      break;
    }
    default:
      b.Add(ToVec(light.position));
  }
  return b;
}

}  // namespace lanelight
