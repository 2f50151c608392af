// Instances that move: each ray meets them where they are at its own time.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "kernels/stages.h"
#include "src/base/core/motion.h"
#include "tests/kernels/intersect/surface_points.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"
#include "tests/support/wave_fixture.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

const FeatureSet kMoving = {Feature::kTriangles, Feature::kInstances, Feature::kScatters,
                            Feature::kMotion, Feature::kMovingInstances};
// Rays take turns in them, so that those of a vector differ.
constexpr std::array<float, 5> kTimes = {0.0f, 0.31f, 0.5f, 0.87f, 1.0f};

float TimeOf(std::size_t ray) { return kTimes[ray % kTimes.size()]; }

void PutTransform(const Transform& t, float to[12]) {
  for (int i = 0; i < 12; ++i) to[i] = static_cast<float>(t(i / 4, i % 4));
}

Transform AnyPlace(Random& random, bool mirrored) {
  const Vec3d scale = {random(0.3f, 2), random(0.3f, 2),
                       (mirrored ? -1 : 1) * random(0.3f, 2)};
  return Transform::Translate(ToDouble(random.Point(2))) *
         Transform::Rotate(random(0, 360), ToDouble(random.Direction())) *
         Transform::Scale(scale);
}

// A soup in the world, two objects, and instances of them of which two thirds move.
struct MovingScene {
  Geometry geometry;
  std::vector<Motion> motions;  // of all instances
  std::uint32_t moving = 0;     // of them

  MovingScene(Random& random, std::uint32_t instances) {
    Geometry& g = geometry;
    g = brute::Soup(random, 5, 2, 0.5f);
    g.groups = {{0, 5}};
    for (const int n : {3, 200}) {
      const Geometry object = brute::Soup(random, n, 0.5f, 0.2f);
      const auto begin = static_cast<std::uint32_t>(g.triangles.size());
      g.triangles.insert(g.triangles.end(), object.triangles.begin(),
                         object.triangles.end());
      g.groups.push_back({begin, static_cast<std::uint32_t>(g.triangles.size())});
    }
    moving = 2 * instances / 3 + 1;
    for (std::uint32_t i = 0; i < instances; ++i) {
      const bool mirrored = i % 3 == 0;
      const Transform start = AnyPlace(random, mirrored);
      Motion motion(start, i < moving ? AnyPlace(random, mirrored) : start);
      if (i < moving && i % 2 == 0) motion.pivot = ToDouble(random.Point(1));
      motions.push_back(motion);
      if (i < moving) g.motions.push_back(RecordOf(motion));
      InstanceRecord record;
      PutTransform(motion.At(0), record.scene_from_object);
      PutTransform(motion.At(0).Inverse(), record.object_from_scene);
      g.instances.push_back(record);
      g.instance_group.push_back(1 + i % 2);
    }
  }

  // The triangle of an instance, or of the world, at a time.
  TriangleRecord At(std::uint32_t prim, std::uint32_t inst, float time) const {
    TriangleRecord triangle = geometry.triangles[prim];
    if (inst == kWorldInstance) return triangle;
    const Transform t = motions[inst].At(time);
    for (auto& p : triangle.p) {
      const Vec3d q = t.Point({p[0], p[1], p[2]});
      for (int a = 0; a < 3; ++a) p[a] = static_cast<float>(q[a]);
    }
    return triangle;
  }
};

// All triangles at one time.
struct Frozen {
  AlignedVector<TriangleRecord> triangles;
  std::vector<std::uint32_t> prim, inst;

  Frozen(const MovingScene& scene, float time) {
    const auto add = [&](std::uint32_t p, std::uint32_t i) {
      triangles.push_back(scene.At(p, i, time));
      prim.push_back(p);
      inst.push_back(i);
    };
    for (std::uint32_t p = 0; p < 5; ++p) add(p, kWorldInstance);
    for (std::uint32_t i = 0; i < scene.motions.size(); ++i) {
      const auto group = scene.geometry.groups[scene.geometry.instance_group[i]];
      for (std::uint32_t p = group.begin; p < group.end; ++p) add(p, i);
    }
  }
};

std::vector<TestRay> RaysOf(Random& random, int count) {
  std::vector<TestRay> rays;
  for (int i = 0; i < count; ++i) rays.push_back({random.Point(2), random.Direction()});
  // Nearly the same: these go through frusta.
  for (int i = 0; i < count; ++i) {
    rays.push_back(
        {{4, 0.1f, 0.2f}, Normalize(Vec3f{-1, 0.1f, 0.1f} + 0.01f * random.Point(1))});
  }
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].time = TimeOf(i);
  return rays;
}

// Closest hits of rays [begin, end), in slots 0, 1, ...
WaveFixture Trace(const CompiledScene& scene, const std::vector<TestRay>& rays,
                  std::size_t begin, std::size_t end) {
  WaveFixture f(scene, static_cast<std::uint32_t>(end - begin));
  f.SetRays({rays.begin() + static_cast<std::ptrdiff_t>(begin),
             rays.begin() + static_cast<std::ptrdiff_t>(end)});
  f.Run(IntersectTrianglesStage, kMoving);
  return f;
}

}  // namespace

TEST_CASE("rays hit moving instances at the position of their time",
          "[intersect][motion]") {
  const EachTarget target;
  Random random(51);
  for (const std::uint32_t instances : {1u, 9u, 40u}) {
    const MovingScene moving(random, instances);
    const CompiledScene scene = MakeScene(moving.geometry);
    const std::vector<TestRay> rays = RaysOf(random, 400);
    std::vector<Frozen> frozen;
    for (const float time : kTimes) frozen.emplace_back(moving, time);
    const WaveFixture f = Trace(scene, rays, 0, rays.size());
    const PathColumns& p = f.wave.path;
    int differ = 0, on_moving = 0;
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      const Frozen& all = frozen[i % kTimes.size()];
      const brute::Hit hit =
          brute::Closest(all.triangles, ToDouble(rays[i].o), ToDouble(rays[i].d));
      if (std::isinf(p.t[i])) open.push_back(i);
      const bool missed = std::isinf(hit.t);
      if (missed || std::isinf(p.t[i])) {
        differ += missed != std::isinf(p.t[i]);
        continue;
      }
      if (p.prim[i] != all.prim[hit.prim] || p.inst[i] != all.inst[hit.prim]) {
        ++differ;
        continue;
      }
      on_moving += p.inst[i] < moving.moving;
      CAPTURE(i, p.prim[i], p.inst[i]);
      REQUIRE(std::abs(double{p.t[i]} - hit.t) < 1e-4);
      REQUIRE(std::abs(double{p.b1[i]} - hit.b1) < 1e-3);
    }
    if (instances > 1) CHECK(on_moving > static_cast<int>(instances));
    CHECK(differ <= 2);  // along edges, after rounding
    WaveFixture shadows(scene, static_cast<std::uint32_t>(rays.size()));
    shadows.SetShadowRays(rays);
    shadows.Run(ShadowTrianglesStage, kMoving);
    const Queue& queue = shadows.wave.queue(QueueId::kShadow);
    CHECK(std::vector<std::uint32_t>(queue.items, queue.items + queue.size) == open);
  }
}

TEST_CASE("a hit on a moving instance does not depend on other rays",
          "[intersect][motion]") {
  Random random(52);
  const MovingScene moving(random, 60);
  const CompiledScene scene = MakeScene(moving.geometry);
  const std::vector<TestRay> rays = RaysOf(random, 300);
  const EachTarget target;
  const WaveFixture together = Trace(scene, rays, 0, rays.size());
  const PathColumns& a = together.wave.path;
  for (const std::size_t company : {1, 6, 37}) {
    for (std::size_t at = 0; at < rays.size(); at += company) {
      const std::size_t end = std::min(rays.size(), at + company);
      const WaveFixture apart = Trace(scene, rays, at, end);
      const PathColumns& b = apart.wave.path;
      for (std::size_t i = at; i < end; ++i) {
        REQUIRE(a.t[i] == b.t[i - at]);
        if (std::isinf(a.t[i])) continue;
        REQUIRE(a.prim[i] == b.prim[i - at]);
        REQUIRE(a.inst[i] == b.inst[i - at]);
        REQUIRE(a.b1[i] == b.b1[i - at]);
        REQUIRE(a.b2[i] == b.b2[i - at]);
      }
    }
  }
}

TEST_CASE("surface points of moving instances lie on the moved surface",
          "[surface][motion]") {
  const EachTarget target;
  Random random(53);
  const MovingScene moving(random, 12);
  const CompiledScene scene = MakeScene(moving.geometry);
  const std::vector<TestRay> rays = RaysOf(random, 500);
  WaveFixture f = Trace(scene, rays, 0, rays.size());
  Queue &queue = f.wave.queue(QueueId::kSurface),
        &shadow = f.wave.queue(QueueId::kShadow);
  const PathColumns& p = f.wave.path;
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    if (!std::isinf(p.t[i])) queue.items[queue.size++] = i;
  }
  f.Run(SurfaceTriangleStage, kMoving);
  for (std::uint32_t k = 0; k < queue.size; ++k) {
    const std::uint32_t i = queue.items[k];
    const TriangleRecord tri = moving.At(p.prim[i], p.inst[i], TimeOf(i));
    CAPTURE(i, p.inst[i]);
    CheckAndLeave(f, i, {tri, rays[i], random.Direction(), 2});
  }
  const std::uint32_t before = shadow.size;
  REQUIRE(before > 100);
  f.Run(ShadowTrianglesStage, kMoving);
  CHECK(shadow.size == before);
}

}  // namespace lanelight
