// Checks of the surface points of instances.
#pragma once

#include <catch2/catch.hpp>

#include "tests/support/brute_force.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {

/// Holds what the surface point of a path is compared with.
struct ExpectedSurface {
  TriangleRecord triangle;  // where it lies in the scene
  TestRay ray;
  Vec3f leaving;     // direction of a shadow ray from there
  double tolerance;  // of lengths, relative to that of instances at rest
};

/// Requires that the point lies on the triangle and on the ray, and that a mirrored
/// instance (every third) keeps the side of the object's normal, as in pbrt. Queues a
/// short shadow ray that leaves the surface and must not meet it.
inline void CheckAndLeave(WaveFixture& f, std::uint32_t i, const ExpectedSurface& want) {
  const PathColumns& p = f.wave.path;
  const auto vertex = [&](int v) {
    const auto& corner = want.triangle.p[v];
    return Vec3d{corner[0], corner[1], corner[2]};
  };
  const Vec3d n = Normalize(Cross(vertex(1) - vertex(0), vertex(2) - vertex(0)));
  const bool mirrored = p.inst[i] != kWorldInstance && p.inst[i] % 3 == 0;
  REQUIRE(Length(n * (mirrored ? -1.0 : 1.0) - brute::ToDouble(f.Ng(i))) <
          1e-4 * want.tolerance);
  REQUIRE(std::abs(Dot(n, brute::ToDouble(f.P(i)) - vertex(0))) < 2e-6 * want.tolerance);
  const Vec3d on_ray =
      brute::ToDouble(want.ray.o) + double{p.t[i]} * brute::ToDouble(want.ray.d);
  REQUIRE(Length(on_ray - brute::ToDouble(f.P(i))) < 1e-4);
  const Vec3f d = want.leaving;
  if (std::abs(Dot(d, f.Ng(i))) < 1e-3f) return;
  p.ls_x[i] = d.x, p.ls_y[i] = d.y, p.ls_z[i] = d.z;
  p.ls_distance[i] = 1e-5f * static_cast<float>(want.tolerance);
  Queue& shadow = f.wave.queue(QueueId::kShadow);
  shadow.items[shadow.size++] = i;
}

}  // namespace lanelight
