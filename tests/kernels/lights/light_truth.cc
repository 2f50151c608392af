#include "tests/kernels/lights/light_truth.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/pi.h"
#include "src/base/image/octahedral.h"

namespace lanelight::test {
namespace {

const Environment& EnvironmentOf(const CompiledScene& scene, const LightRecord& light) {
  return scene.lights.environments[static_cast<std::size_t>(light.environment)];
}

double SpotFalloff(const LightRecord& light, Vec3d w) {
  const double cosine = -Dot(w, ToVec(light.direction));
  const double low = 1 - double(light.versine_total);
  const double high = 1 - double(light.versine_falloff);
  const double x = std::clamp((cosine - low) / (high - low), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

// A rectangle's light, too, is made of triangles: the first of them is `primitive`.
struct Corners {
  Vec3d p[3];
};
Corners CornersOf(const CompiledScene& scene, const LightRecord& light) {
  const TriangleRecord& t = scene.geometry.triangles[light.primitive];
  return {{ToVec(t.p[0]), ToVec(t.p[1]), ToVec(t.p[2])}};
}
const SphereRecord& SphereOf(const CompiledScene& scene, const LightRecord& light) {
  return scene.geometry.spheres[light.primitive - scene.geometry.ranges.spheres];
}
const DiskRecord& DiskOf(const CompiledScene& scene, const LightRecord& light) {
  return scene.geometry.disks[light.primitive - scene.geometry.ranges.disks];
}

// Completes what lies on a plane with this normal at distance t.
void OnSurface(VisibleLight& seen, const LightRecord& light, Vec3d n, Vec3d w) {
  seen.cosine = std::abs(Dot(n, w));
  seen.facing = light.two_sided != 0 || Dot(n, w) < 0;
  seen.pdf = seen.distance * seen.distance / (light.area * seen.cosine);
}

VisibleLight LookAtTriangle(const CompiledScene& scene, const LightRecord& light,
                            Vec3d from, Vec3d w) {
  VisibleLight seen;
  const Corners c = CornersOf(scene, light);
  const Vec3d e1 = c.p[1] - c.p[0], e2 = c.p[2] - c.p[0], n = Cross(e1, e2);
  seen.distance = Dot(c.p[0] - from, n) / Dot(w, n);
  const Vec3d q = from + w * seen.distance - c.p[0];
  const double b1 = Dot(Cross(q, e2), n) / Dot(n, n);
  const double b2 = Dot(Cross(e1, q), n) / Dot(n, n);
  seen.met = seen.distance > 0 && std::min({b1, b2, 1 - b1 - b2}) > -1e-4;
  OnSurface(seen, light, Normalize(n), w);
  return seen;
}

// Through whichever of its two triangles.
VisibleLight LookAtRectangle(const CompiledScene& scene, const LightRecord& light,
                             Vec3d from, Vec3d w) {
  LightRecord half = light;
  const VisibleLight first = LookAtTriangle(scene, half, from, w);
  half.primitive = light.second_primitive;
  return first.met ? first : LookAtTriangle(scene, half, from, w);
}

VisibleLight LookAtDisk(const CompiledScene& scene, const LightRecord& light, Vec3d from,
                        Vec3d w) {
  VisibleLight seen;
  const DiskRecord& disk = DiskOf(scene, light);
  const Vec3d center = ToVec(disk.center), n = ToVec(disk.normal);
  seen.distance = Dot(center - from, n) / Dot(w, n);
  const double r = Length(from + w * seen.distance - center);
  seen.met = seen.distance > 0 && r < disk.radius * (1 + 1e-4) &&
             r > disk.inner_radius * (1 - 1e-4);
  OnSurface(seen, light, Normalize(n), w);
  return seen;
}

// From outside the sphere is sampled by its cone of directions, from inside by its area.
VisibleLight LookAtSphere(const CompiledScene& scene, const LightRecord& light,
                          Vec3d from, Vec3d w) {
  VisibleLight seen;
  const SphereRecord& sphere = SphereOf(scene, light);
  const Vec3d c = ToVec(sphere.center) - from;
  const double r = sphere.radius, d2 = Dot(c, c), along = Dot(c, w);
  const double half2 = r * r - Dot(c - w * along, c - w * along);
  const double half = std::sqrt(std::max(0.0, half2));
  const bool outside = d2 > r * r;
  seen.distance = outside ? along - half : along + half;
  seen.met = half2 > -1e-4 * r * r && seen.distance > 0;
  const Vec3d n = Normalize(w * seen.distance - c) * double{sphere.normal_sign};
  OnSurface(seen, light, n, w);
  if (outside) seen.pdf = 1 / (2 * kPi * (1 - std::sqrt(1 - r * r / d2)));
  return seen;
}

VisibleLight LookAtSky(const CompiledScene& scene, const LightRecord& light, Vec3d w) {
  VisibleLight seen;
  seen.met = seen.facing = true;
  seen.distance = std::numeric_limits<double>::infinity();
  if (light.environment < 0) {
    seen.radiance = ToVec(light.radiance);
    seen.pdf = 1 / (4 * kPi);
    return seen;
  }
  const Environment& e = EnvironmentOf(scene, light);
  const float* m = e.light_from_scene;
  const Vec3d local = {Dot(ToVec(m), w), Dot(ToVec(m + 3), w), Dot(ToVec(m + 6), w)};
  const auto [u, v] = DirectionToOctahedral(Normalize(local));
  const int x = std::clamp(static_cast<int>(u * e.size), 0, e.size - 1);
  const int y = std::clamp(static_cast<int>(v * e.size), 0, e.size - 1);
  // Rounding may move a direction over the edge of a texel.
  const double edge = std::min({std::abs(u * e.size - std::round(u * e.size)),
                                std::abs(v * e.size - std::round(v * e.size))});
  seen.met = edge > 1e-5 * e.size;
  seen.radiance = ToVec(&e.rgb[3 * static_cast<std::size_t>(y * e.size + x)]);
  double total = 0;
  for (std::size_t i = 0; i < e.rgb.size(); i += 3) total += Luminance(ToVec(&e.rgb[i]));
  // The factor of a matrix with determinant 1.
  const double stretch = 1 / std::pow(Length(local), 3);
  seen.pdf = Luminance(seen.radiance) / total * e.size * e.size / (4 * kPi) * stretch;
  return seen;
}

}  // namespace

VisibleLight FindVisibleLight(const CompiledScene& scene, const LightRecord& light,
                              Vec3d from, Vec3d w, bool solid_angle) {
  VisibleLight seen;
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kTriangle:
      seen = LookAtTriangle(scene, light, from, w);
      if (solid_angle) seen.pdf = 1 / SolidAngleOf(scene, light, from).steradians;
      break;
    case LightShape::kRectangle:
      seen = LookAtRectangle(scene, light, from, w);
      if (solid_angle) seen.pdf = 1 / SolidAngleOf(scene, light, from).steradians;
      break;
    case LightShape::kSphere:
      seen = LookAtSphere(scene, light, from, w);
      break;
    case LightShape::kDisk:
      seen = LookAtDisk(scene, light, from, w);
      break;
    case LightShape::kInfiniteConstant:
    case LightShape::kInfiniteImage:
      return LookAtSky(scene, light, w);
    case LightShape::kPoint:
    case LightShape::kSpot: {
      const Vec3d to = ToVec(light.position) - from;
      seen.met = Length(Normalize(to) - w) < 1e-6;
      seen.facing = true;
      seen.distance = Length(to);
      const bool spot = light.shape == static_cast<std::uint32_t>(LightShape::kSpot);
      const double falloff = spot ? SpotFalloff(light, w) : 1;
      seen.radiance = ToVec(light.radiance) * (falloff / Dot(to, to));
      return seen;
    }
    case LightShape::kDistant:
      seen.met = Length(ToVec(light.direction) - w) < 1e-6;
      seen.facing = true;
      seen.distance = std::numeric_limits<double>::infinity();
      seen.radiance = ToVec(light.radiance);
      return seen;
    case LightShape::kGoniometric:  // image_lights_test.cc
    case LightShape::kProjection:
    case LightShape::kPortal:
    case LightShape::kCount:
      break;
  }
  seen.radiance = ToVec(light.radiance);
  return seen;
}

SolidAngle SolidAngleOf(const CompiledScene& scene, const LightRecord& light,
                        Vec3d from) {
  const auto cap = [](double cosine, Vec3d axis) {
    return SolidAngle{2 * kPi * (1 - cosine), axis * (kPi * (1 - cosine * cosine))};
  };
  switch (static_cast<LightShape>(light.shape)) {
    case LightShape::kTriangle: {
      // Van Oosterom and Strackee 1983; Lambert's formula for the moment.
      const Corners c = CornersOf(scene, light);
      Vec3d r[3], moment;
      for (int k = 0; k < 3; ++k) r[k] = Normalize(c.p[k] - from);
      const double volume = Dot(r[0], Cross(r[1], r[2]));
      const double angle =
          2 * std::atan2(std::abs(volume),
                         1 + Dot(r[0], r[1]) + Dot(r[1], r[2]) + Dot(r[2], r[0]));
      for (int k = 0; k < 3; ++k) {
        const Vec3d edge = Cross(r[k], r[(k + 1) % 3]);
        const double theta = std::atan2(Length(edge), Dot(r[k], r[(k + 1) % 3]));
        moment += Normalize(edge) * (theta / 2);
      }
      return {angle, volume < 0 ? -moment : moment};
    }
    case LightShape::kRectangle: {
      LightRecord half = light;
      half.shape = static_cast<std::uint32_t>(LightShape::kTriangle);
      const SolidAngle first = SolidAngleOf(scene, half, from);
      half.primitive = light.second_primitive;
      const SolidAngle second = SolidAngleOf(scene, half, from);
      return {first.steradians + second.steradians, first.moment + second.moment};
    }
    case LightShape::kSphere: {
      const SphereRecord& sphere = SphereOf(scene, light);
      const Vec3d to = ToVec(sphere.center) - from;
      const double s2 = sphere.radius * sphere.radius / Dot(to, to);
      if (s2 > 1) return {4 * kPi, {}};
      return cap(std::sqrt(1 - s2), Normalize(to));
    }
    case LightShape::kDisk: {
      const DiskRecord& disk = DiskOf(scene, light);
      const Vec3d to = ToVec(disk.center) - from;
      const auto cosine = [&](double r) { return 1 / std::hypot(1, r / Length(to)); };
      const SolidAngle outer = cap(cosine(disk.radius), Normalize(to));
      const SolidAngle inner = cap(cosine(disk.inner_radius), Normalize(to));
      return {outer.steradians - inner.steradians, outer.moment - inner.moment};
    }
    default:
      return {4 * kPi, {}};
  }
}

}  // namespace lanelight::test
