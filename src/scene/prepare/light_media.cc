#include "src/scene/prepare/light_media.h"

#include <cmath>

#include "src/base/core/vec.h"
#include "src/scene/geometry/geometry.h"
#include "src/scene/prepare/medium_map.h"

namespace lanelight {
namespace {

// A point of a light with the normal on the side that emits; zero without a surface.
struct SurfacePoint {
  Vec3d p, n;
};
using PointList = std::vector<SurfacePoint>;

PointList OnRectangle(const LightRecord& light) {
  const Vec3d x = ToVec(light.direction), y = ToVec(light.side);
  PointList points;
  for (const double u : {0.01, 0.5, 0.99}) {
    for (const double v : {0.01, 0.5, 0.99}) {
      const Vec3d inside =
          x * (u * double(light.size[0])) + y * (v * double(light.size[1]));
      points.push_back({ToVec(light.position) + inside, Cross(x, y)});
    }
  }
  return points;
}

PointList OnTriangle(const TriangleRecord& t) {
  const Vec3d p[] = {ToVec(t.p[0]), ToVec(t.p[1]), ToVec(t.p[2])};
  const Vec3d n = Normalize(Cross(p[1] - p[0], p[2] - p[0]));
  const Vec3d middle = (p[0] + p[1] + p[2]) / 3.0;
  PointList points = {{middle, n}};
  for (const Vec3d& corner : p) points.push_back({middle + (corner - middle) * 0.98, n});
  return points;
}

PointList OnSphere(const SphereRecord& sphere) {
  PointList points;
  for (const double sign : {-1.0, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d out{};
      out[axis] = sign;
      points.push_back({ToVec(sphere.center) + out * double(sphere.radius),
                        out * double(sphere.normal_sign)});
    }
  }
  return points;
}

PointList OnDisk(const DiskRecord& disk) {
  const Vec3d n = ToVec(disk.normal), x = ToVec(disk.u_axis), y = Cross(n, x);
  PointList points;
  for (const double r : {double(disk.radius) * 0.99, double(disk.inner_radius) * 1.01}) {
    for (const Vec3d& side : {x, y, -x, -y}) {
      points.push_back({ToVec(disk.center) + side * r, n});
    }
  }
  return points;
}

PointList PointsOf(const Geometry& g, const LightRecord& light) {
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kRectangle:
      return OnRectangle(light);
    case LightShape::kTriangle:
      return OnTriangle(g.triangles[light.primitive]);
    case LightShape::kSphere:
      return OnSphere(g.spheres[light.primitive - g.ranges.spheres]);
    case LightShape::kDisk:
      return OnDisk(g.disks[light.primitive - g.ranges.disks]);
    default:
      return {{ToVec(light.position), {}}};
  }
}

// Returns the medium on the side of a light's normal (1) or behind it (-1).
std::int32_t MediumBeside(const Geometry& g, const LightRecord& light, double side,
                          MediumMap& map) {
  const PointList points = PointsOf(g, light);
  std::int32_t medium = MediumMap::kUnclear;
  for (const SurfacePoint& point : points) {
    const double clearance =
        1e-5 * (LargestComponent(point.p) + std::sqrt(double(light.area)));
    const std::int32_t found = map.At(point.p + point.n * (side * clearance));
    if (&point != &points[0] && found != medium) return MediumMap::kUnclear;
    medium = found;
  }
  return medium;
}

bool IsFar(const LightRecord& light) {
  return HasTrait(static_cast<LightShape>(light.shape), kFarLight);
}

}  // namespace

AlignedVector<std::int32_t> FindLightMedia(const CompiledScene& scene,
                                           std::vector<double>& weights) {
  const AlignedVector<LightRecord>& lights = scene.lights.lights;
  AlignedVector<std::int32_t> media;
  if (scene.media.primitives.empty()) {
    const bool dark = scene.media.camera != kVacuum;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (dark && IsFar(lights[i])) weights[i] = 0;
    }
    return media;
  }
  MediumMap map(scene);
  media.assign(2 * weights.size(), kVacuum);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!map.IsConsistent()) weights[i] = 0;
    if (weights[i] == 0) continue;
    const LightRecord& light = lights[i];
    std::int32_t before = map.Outside(), behind = kVacuum;
    if (!IsFar(light)) {
      before = MediumBeside(scene.geometry, light, 1, map);
      if (light.two_sided != 0) behind = MediumBeside(scene.geometry, light, -1, map);
    }
    const bool unclear = before == MediumMap::kUnclear || behind == MediumMap::kUnclear;
    if (unclear || (IsFar(light) && before != kVacuum)) weights[i] = 0;
    media[2 * i] = behind;
    media[2 * i + 1] = before;
  }
  return media;
}

}  // namespace lanelight
