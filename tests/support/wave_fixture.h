// A scene of bare geometry and a wavefront with every column, to test kernels without the
// engine.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "kernels/stages.h"
#include "src/scene/accel/build.h"
#include "src/scene/compiled/scene.h"
#include "src/vocabulary/path/stage.h"
#include "tests/support/test_target.h"

namespace lanelight {

/// Triangle with material = its index.
inline TriangleRecord MakeTriangle(Vec3f a, Vec3f b, Vec3f c) {
  return {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}, 0, -1, 0};
}
inline SphereRecord MakeSphere(Vec3f center, float radius) {
  return {
      {center.x, center.y, center.z}, radius, 0, -1, 0, 1, {1, 0, 0}, {0, 0, 1}, 1, 0};
}
inline DiskRecord MakeDisk(Vec3f center, Vec3f normal, float radius, float inner = 0) {
  const Vec3f n = Normalize(normal);
  const Vec3f u =
      Normalize(Cross(n, std::abs(n.x) > 0.5f ? Vec3f{0, 1, 0} : Vec3f{1, 0, 0}));
  return {{center.x, center.y, center.z},
          radius,
          {n.x, n.y, n.z},
          inner,
          {u.x, u.y, u.z},
          0,
          -1,
          0,
          1,
          0};
}
inline PlaneRecord MakePlane(Vec3f point, Vec3f normal) {
  const Vec3f n = Normalize(normal);
  const Vec3f u =
      Normalize(Cross(n, std::abs(n.x) > 0.5f ? Vec3f{0, 1, 0} : Vec3f{1, 0, 0}));
  const Vec3f v = Cross(n, u);
  return {{point.x, point.y, point.z},
          0,
          {n.x, n.y, n.z},
          -1,
          {u.x, u.y, u.z},
          0,
          {v.x, v.y, v.z},
          0};
}

/// Completes `geometry` (ranges, groups, materials = ids) and builds its acceleration
/// structures. Instances and groups are kept if there are any.
inline CompiledScene MakeScene(Geometry geometry, const AccelOptions& options) {
  CompiledScene scene;
  const auto count = [](const auto& v) { return static_cast<std::uint32_t>(v.size()); };
  PrimitiveRanges& ranges = geometry.ranges;
  ranges.spheres = count(geometry.triangles);
  ranges.disks = ranges.spheres + count(geometry.spheres);
  ranges.planes = ranges.disks + count(geometry.disks);
  ranges.large_spheres = ranges.planes + count(geometry.planes);
  ranges.curves = ranges.large_spheres + count(geometry.large_spheres);
  ranges.end = ranges.curves + count(geometry.curves);
  if (geometry.groups.empty()) geometry.groups.push_back({0, ranges.spheres});
  std::uint32_t id = 0;
  for (auto& r : geometry.triangles) r.material = id++;
  for (auto& r : geometry.spheres) r.material = id++;
  for (auto& r : geometry.disks) r.material = id++;
  for (auto& r : geometry.planes) r.material = id++;
  for (auto& r : geometry.large_spheres) r.material = id++;
  scene.geometry = std::move(geometry);
  scene.accel = BuildAccel(scene.geometry, options);
  return scene;
}

/// The same as a render on the current target does it.
inline CompiledScene MakeScene(Geometry geometry) {
  return MakeScene(std::move(geometry),
                   {.leaf_triangles = LeafTrianglesFor(TestTarget().lanes())});
}

struct TestRay {
  Vec3f o, d;
  float t_max = std::numeric_limits<float>::infinity();
  std::uint32_t from = kNoPrimitive;  // the triangle that the ray starts on
  float time = 0;
};

/// A wavefront whose slots are all in kActive, kSurface or kShadow at will.
class WaveFixture {
 public:
  WaveFixture(const SceneParts& scene, std::uint32_t capacity) {
    static_cast<SceneParts&>(wave) = scene;
    wave.run = &run;
    wave.capacity = capacity;
    storage_.reserve(kNumFields + kNumQueues);
#define X(type, name, ...) wave.path.name = reinterpret_cast<type*>(NewColumn(capacity));
    LANELIGHT_PATH_FIELDS(X)
#undef X
    wave.path.passed = nullptr;      // no interfaces of media behind a ray
    wave.path.wavelength = nullptr;  // paths carry red, green and blue
    wave.path.eta = nullptr;
    wave.path.hit_weight = nullptr;  // no light subpaths
    wave.path.light_row = nullptr;   // no light-selection=learned
    for (Queue& queue : wave.queues) queue.items = NewColumn(capacity);
    wave.lists = ColumnLists(wave.path, FeatureSet::All());
  }

  /// Makes the wave of a scene whose lights are not sampled.
  WaveFixture(const CompiledScene& scene, std::uint32_t capacity)
      : WaveFixture(PartsOf(scene, scene.view, nullptr), capacity) {}

  /// Writes rays to slots 0.. in the order given and queues them in kActive.
  void SetRays(const std::vector<TestRay>& rays) {
    for (std::uint32_t i = 0; i < rays.size(); ++i) SetRay(i, rays[i]);
    QueueAll(QueueId::kActive, static_cast<std::uint32_t>(rays.size()));
  }
  void SetRay(std::uint32_t slot, const TestRay& ray) {
    PathColumns& p = wave.path;
    p.o_x[slot] = ray.o.x, p.o_y[slot] = ray.o.y, p.o_z[slot] = ray.o.z;
    p.d_x[slot] = ray.d.x, p.d_y[slot] = ray.d.y, p.d_z[slot] = ray.d.z;
    p.t[slot] = ray.t_max;
    p.prim[slot] = ray.from;
    p.inst[slot] = kWorldInstance;
    p.time[slot] = ray.time;
  }
  /// Shadow rays that start exactly at o (no offset), queued in kShadow.
  void SetShadowRays(const std::vector<TestRay>& rays) {
    PathColumns& p = wave.path;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      p.p_x[i] = rays[i].o.x, p.p_y[i] = rays[i].o.y, p.p_z[i] = rays[i].o.z;
      p.ng_x[i] = 0, p.ng_y[i] = 0, p.ng_z[i] = 1, p.p_error[i] = 0;
      p.ls_x[i] = rays[i].d.x, p.ls_y[i] = rays[i].d.y, p.ls_z[i] = rays[i].d.z;
      p.ls_distance[i] = rays[i].t_max;
      p.prim[i] = rays[i].from;
      p.time[i] = rays[i].time;
    }
    QueueAll(QueueId::kShadow, static_cast<std::uint32_t>(rays.size()));
  }
  void QueueAll(QueueId id, std::uint32_t count) {
    Queue& queue = wave.queue(id);
    queue.size = count;
    for (std::uint32_t i = 0; i < count; ++i) queue.items[i] = i;
  }
  /// Runs a stage's kernel of the target that is forced once.
  void Run(StageOn stage, const FeatureSet& features) {
    stage(TestTarget()).resolve(features)(wave);
  }

  Vec3f P(std::uint32_t i) const {
    return {wave.path.p_x[i], wave.path.p_y[i], wave.path.p_z[i]};
  }
  Vec3f Ng(std::uint32_t i) const {
    return {wave.path.ng_x[i], wave.path.ng_y[i], wave.path.ng_z[i]};
  }
  Vec3f Ns(std::uint32_t i) const {
    return {wave.path.ns_x[i], wave.path.ns_y[i], wave.path.ns_z[i]};
  }

  Wave wave;
  RunParameters run;

 private:
  std::uint32_t* NewColumn(std::uint32_t capacity) {
    storage_.emplace_back(capacity + 32, 0xdeadbeefu);
    return storage_.back().data();
  }
  std::vector<AlignedVector<std::uint32_t>> storage_;
};

}  // namespace lanelight
