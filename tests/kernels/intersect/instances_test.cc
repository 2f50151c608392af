// Instances: the same hits as the flattened scene, ties, nested trees of every size.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "kernels/stages.h"
#include "src/base/core/transform.h"
#include "tests/kernels/intersect/surface_points.h"
#include "tests/kernels/intersect/trace.h"
#include "tests/support/brute_force.h"
#include "tests/support/each_target.h"

namespace lanelight {
namespace {

using brute::Random;
using brute::ToDouble;

const FeatureSet kInstanced = {Feature::kTriangles, Feature::kInstances,
                               Feature::kScatters};

InstanceRecord MakeInstance(const Transform& scene_from_object) {
  InstanceRecord record;
  const Transform inverse = scene_from_object.Inverse();
  for (int i = 0; i < 12; ++i) {
    record.scene_from_object[i] = static_cast<float>(scene_from_object(i / 4, i % 4));
    record.object_from_scene[i] = static_cast<float>(inverse(i / 4, i % 4));
  }
  return record;
}

struct InstancedAndFlat {
  Geometry instanced, flat;
  std::vector<std::uint32_t> prim, inst;  // of each triangle of `flat`
};

// A world soup and two object definitions of different size, placed several times with
// rotation, uneven scale, mirroring and translation.
InstancedAndFlat MakePair(Random& random, int instances) {
  InstancedAndFlat pair;
  Geometry& g = pair.instanced;
  g = brute::Soup(random, 5, 2, 0.5f);
  g.groups = {{0, 5}};
  for (const int n : {3, 200}) {
    const Geometry object = brute::Soup(random, n, 0.5f, 0.2f);
    const auto begin = static_cast<std::uint32_t>(g.triangles.size());
    g.triangles.insert(g.triangles.end(), object.triangles.begin(),
                       object.triangles.end());
    g.groups.push_back({begin, static_cast<std::uint32_t>(g.triangles.size())});
  }
  for (std::uint32_t i = 0; i < 5; ++i) {
    pair.flat.triangles.push_back(g.triangles[i]);
    pair.prim.push_back(i);
    pair.inst.push_back(kWorldInstance);
  }
  for (int i = 0; i < instances; ++i) {
    const Vec3d scale = {random(0.3f, 2), random(0.3f, 2), i % 3 ? random(0.3f, 2) : -1};
    const Transform t = Transform::Translate(ToDouble(random.Point(2))) *
                        Transform::Rotate(random(0, 360), ToDouble(random.Direction())) *
                        Transform::Scale(scale);
    g.instances.push_back(MakeInstance(t));
    g.instance_group.push_back(1 + i % 2);
    const Geometry::TriangleGroup group = g.groups[1 + i % 2];
    for (std::uint32_t id = group.begin; id < group.end; ++id) {
      TriangleRecord tri = g.triangles[id];
      for (auto& p : tri.p) {
        const Vec3d q = t.Point({p[0], p[1], p[2]});
        for (int a = 0; a < 3; ++a) p[a] = static_cast<float>(q[a]);
      }
      pair.flat.triangles.push_back(tri);
      pair.prim.push_back(id);
      pair.inst.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return pair;
}

}  // namespace

TEST_CASE("instances give the hits of the flattened scene", "[intersect]") {
  const EachTarget target;
  Random random(41);
  for (const int instances : {1, 9, 40}) {
    const InstancedAndFlat pair = MakePair(random, instances);
    const CompiledScene instanced = MakeScene(pair.instanced),
                        flat = MakeScene(pair.flat);
    std::vector<TestRay> rays;
    for (int i = 0; i < 800; ++i) rays.push_back({random.Point(2), random.Direction()});
    const std::vector<StageOn> stages = {IntersectTrianglesStage};
    const auto a = TraceClosest(instanced, rays, stages, kInstanced);
    const auto b = TraceClosest(flat, rays, stages);
    int differ = 0, hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits += !std::isinf(b[i].t);
      if (std::isinf(a[i].t) != std::isinf(b[i].t)) {
        ++differ;  // a ray along an edge may fall on either side after rounding
        continue;
      }
      if (std::isinf(a[i].t)) continue;
      const bool same =
          a[i].prim == pair.prim[b[i].prim] && a[i].inst == pair.inst[b[i].prim];
      differ += !same;
      if (!same) continue;
      CAPTURE(i, a[i].prim, a[i].inst);
      REQUIRE(std::abs(a[i].t - b[i].t) < 1e-4);
      REQUIRE(std::abs(a[i].b1 - b[i].b1) < 1e-3);
    }
    CHECK(hits > 3 * instances);
    CHECK(differ <= 1);
    // Any hit agrees with closest hit.
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      rays[i].t_max = 1.5f;
      if (!(a[i].t < rays[i].t_max)) open.push_back(i);
    }
    CHECK(Unoccluded(instanced, rays, {ShadowTrianglesStage}, kInstanced) == open);
  }
}

namespace {

// Instances in the same place as one before them, which is the nearer one.
using Copies = std::set<std::uint32_t>;

// A scene whose instances overlap, some of them twice in the same place, or so often that
// no node holds them all, over an object with a deep tree; half of its triangles are cut
// out half.
CompiledScene Crowd(Random& random, Copies& copies) {
  Geometry g = MakePair(random, 40).instanced;
  const Geometry object = brute::Soup(random, 4000, 0.5f, 0.05f);
  const auto begin = static_cast<std::uint32_t>(g.triangles.size());
  g.triangles.insert(g.triangles.end(), object.triangles.begin(), object.triangles.end());
  g.groups.push_back({begin, static_cast<std::uint32_t>(g.triangles.size())});
  for (int i = 0; i < 60; ++i) {
    const Transform t = Transform::Translate(ToDouble(random.Point(2))) *
                        Transform::Rotate(random(0, 360), ToDouble(random.Direction()));
    const bool often = i % 3 == 0;
    const int places = often ? kBvhWidth + 4 : 1 + i % 2;
    for (int k = 0; k < places; ++k) {
      if (k > 0) copies.insert(static_cast<std::uint32_t>(g.instances.size()));
      g.instances.push_back(MakeInstance(t));
      g.instance_group.push_back(often ? 1 : 3);
    }
  }
  for (std::size_t i = 0; i < g.triangles.size(); i += 2) {
    g.triangles[i].flags = kAlphaTested;
  }
  CompiledScene scene = MakeScene(g);
  scene.alpha.texture.assign(g.triangles.size(), -1);
  scene.alpha.constant.assign(g.triangles.size(), 0.5f);
  return scene;
}

}  // namespace

TEST_CASE("a hit on an instance does not depend on other rays", "[intersect]") {
  // Alone a ray enters instances by itself; with others like it in a vector. Ties between
  // coincident instances and cut-outs are decided alike.
  Random random(43);
  Copies copies;
  const CompiledScene scene = Crowd(random, copies);
  std::vector<TestRay> rays;
  for (int i = 0; i < 300; ++i) rays.push_back({random.Point(2), random.Direction()});
  for (const float width : {0.3f, 0.1f, 0.01f}) {
    for (int i = 0; i < 300; ++i) {
      rays.push_back(
          {{4, 0.1f, 0.2f}, Normalize(Vec3f{-1, 0.1f, 0.1f} + width * random.Point(1))});
    }
  }
  FeatureSet cut_out = kInstanced;
  cut_out.Add(Feature::kAlpha);
  const EachTarget target;
  for (const FeatureSet& features : {kInstanced, cut_out}) {
    CAPTURE(features.Has(Feature::kAlpha));
    const std::vector<StageOn> closest = {IntersectTrianglesStage};
    const auto together = TraceClosest(scene, rays, closest, features);
    const auto hits =
        std::ranges::count_if(together, [](const auto& h) { return !std::isinf(h.t); });
    CHECK(hits > 500);
    CHECK(std::ranges::none_of(together,
                               [&](const auto& h) { return copies.contains(h.inst); }));
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      if (std::isinf(together[i].t)) expected.push_back(i);
    }
    CHECK(Unoccluded(scene, rays, {ShadowTrianglesStage}, features) == expected);
    for (const std::size_t company : {1, 6, 37}) {
      std::vector<KernelHit> apart;
      for (std::size_t at = 0; at < rays.size(); at += company) {
        const std::size_t end = std::min(rays.size(), at + company);
        const auto part = TraceClosest(scene, {rays.begin() + at, rays.begin() + end},
                                       closest, features);
        apart.insert(apart.end(), part.begin(), part.end());
      }
      CHECK(apart == together);
    }
  }
}

TEST_CASE("ties between instances go to the smaller index", "[intersect]") {
  // Stretched along z by a power of two an object keeps its triangle at z = 0, and the
  // hits on it their bits; the other triangle has the stretched one's box met first.
  Geometry g;
  g.groups = {{0, 0}, {0, 2}};
  g.triangles.resize(2);
  const float flat[3][3] = {{-2, -2, 0}, {2, -2, 0}, {0, 3, 0}};
  const float ahead[3][3] = {{1.5f, 1, 1}, {1.6f, 1, 1}, {1.5f, 1.1f, 1}};
  std::copy_n(&flat[0][0], 9, &g.triangles[0].p[0][0]);
  std::copy_n(&ahead[0][0], 9, &g.triangles[1].p[0][0]);
  for (const int scale : {1, 2, 4, 1}) {
    g.instances.push_back(MakeInstance(Transform::Scale({1, 1, double(scale)})));
    g.instance_group.push_back(1);
  }
  const CompiledScene scene = MakeScene(g);
  Random random(45);
  std::vector<TestRay> rays;
  for (const float width : {0.01f, 0.3f}) {
    for (int i = 0; i < 64; ++i) {
      rays.push_back({{0.1f, 0.2f, 9},
                      Normalize(Vec3f{0.02f, 0.03f, -1} + width * random.Point(1))});
    }
  }
  const EachTarget target;
  for (const KernelHit& hit :
       TraceClosest(scene, rays, {IntersectTrianglesStage}, kInstanced)) {
    REQUIRE(hit.prim == 0);
    REQUIRE(hit.inst == 0);
  }
}

TEST_CASE("a ray beyond the range of float hits no instance", "[intersect]") {
  Random random(44);
  Geometry g = MakePair(random, 20).instanced;
  for (InstanceRecord& record : g.instances) {
    for (float& m : record.object_from_scene) m *= 1e30f;
  }
  const CompiledScene scene = MakeScene(g);
  std::vector<TestRay> rays;
  for (int i = 0; i < 100; ++i) {
    rays.push_back({1e12f * random.Point(1), random.Direction()});
    rays.push_back({{NAN, 0, 0}, random.Direction()});
    rays.push_back({random.Point(1), {0, NAN, 1}});
  }
  const EachTarget target;
  for (const KernelHit& hit :
       TraceClosest(scene, rays, {IntersectTrianglesStage}, kInstanced)) {
    REQUIRE(std::isinf(hit.t));
  }
}

TEST_CASE("surfaces of instances lie on the flattened triangles", "[surface]") {
  const EachTarget target;
  Random random(42);
  const InstancedAndFlat pair = MakePair(random, 12);
  const CompiledScene scene = MakeScene(pair.instanced);
  std::vector<TestRay> rays;
  for (int i = 0; i < 800; ++i) rays.push_back({random.Point(2), random.Direction()});
  WaveFixture f(scene, 800);
  f.SetRays(rays);
  f.Run(IntersectTrianglesStage, kInstanced);
  Queue& queue = f.wave.queue(QueueId::kSurface);
  const PathColumns& p = f.wave.path;
  for (std::uint32_t i = 0; i < 800; ++i) {
    if (!std::isinf(p.t[i])) queue.items[queue.size++] = i;
  }
  f.Run(SurfaceTriangleStage, kInstanced);
  Queue& shadow = f.wave.queue(QueueId::kShadow);
  for (std::uint32_t k = 0; k < queue.size; ++k) {
    const std::uint32_t i = queue.items[k];
    std::size_t at = 0;
    while (pair.prim[at] != p.prim[i] || pair.inst[at] != p.inst[i]) ++at;
    const TriangleRecord& tri = pair.flat.triangles[at];
    CheckAndLeave(f, i, {tri, rays[i], random.Direction(), 1});
  }
  const std::uint32_t before = shadow.size;
  REQUIRE(before > 100);
  f.Run(ShadowTrianglesStage, kInstanced);
  CHECK(shadow.size == before);
}

TEST_CASE("coincident instances tie to the smaller index", "[intersect]") {
  const EachTarget target;
  Geometry g;
  g.triangles = {MakeTriangle({-1, -1, 1}, {1, -1, 1}, {0, 1, 1})};
  g.groups = {{0, 0}, {0, 1}};
  for (int i = 0; i < 20; ++i) {
    g.instances.push_back(MakeInstance(Transform()));
    g.instance_group.push_back(1);
  }
  const auto hits = TraceClosest(MakeScene(g), {{{0, 0, 0}, {0, 0, 1}}},
                                 {IntersectTrianglesStage}, kInstanced);
  CHECK(hits[0].t == 1);
  CHECK(hits[0].inst == 0);
}

}  // namespace lanelight
