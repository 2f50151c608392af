#include "bench/intersect/scene_rays.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/render/job/job.h"

namespace lanelight::bench {
namespace {

// Stands between the driver and a kernel. Kernels are bare functions, hence the globals;
// one thread renders.
struct Tap {
  StageFn kernel = nullptr;
  RaySet set;
  std::size_t step = 1, calls = 0, rays = 0;

  void Start(std::size_t sample_stride) {
    step = sample_stride;
    calls = rays = 0;
  }
  bool IsSampled(std::uint32_t size) {
    rays += size;
    return step > 0 && calls++ % step == 0;
  }
};
Tap closest_tap, shadow_tap;

TestRay ClosestRay(const PathColumns& p, std::uint32_t i) {
  return {
      {p.o_x[i], p.o_y[i], p.o_z[i]}, {p.d_x[i], p.d_y[i], p.d_z[i]}, p.t[i], p.prim[i]};
}

// The origin is moved off the surface as the kernels do it.
TestRay ShadowRay(const PathColumns& p, std::uint32_t i) {
  const Vec3f d{p.ls_x[i], p.ls_y[i], p.ls_z[i]}, n{p.ng_x[i], p.ng_y[i], p.ng_z[i]};
  const Vec3f from{p.p_x[i], p.p_y[i], p.p_z[i]};
  return {from + std::copysign(p.p_error[i], Dot(n, d)) * n, d, p.ls_distance[i],
          p.prim[i]};
}

template <Tap& kTap, QueueId kQueue, TestRay (&kRay)(const PathColumns&, std::uint32_t)>
void Record(Wave& wave) {
  const Queue& queue = wave.queue(kQueue);
  if (kTap.IsSampled(queue.size)) {
    for (std::uint32_t i = 0; i < queue.size; ++i) {
      kTap.set.rays.push_back(kRay(wave.path, queue.items[i]));
    }
    kTap.set.waves.push_back(queue.size);
  }
  kTap.kernel(wave);
}

void InsertTaps(Plan& plan) {
  for (PlannedStage& planned : plan.phases[0].stages) {
    const std::string name = planned.stage.name;
    if (name == "intersect_triangles") {
      closest_tap = {planned.kernel, {"closest", false, {}, {}}};
      planned.kernel = Record<closest_tap, QueueId::kActive, ClosestRay>;
    }
    if (name == "shadow_triangles") {
      shadow_tap = {planned.kernel, {"shadow", true, {}, {}}};
      planned.kernel = Record<shadow_tap, QueueId::kShadow, ShadowRay>;
    }
  }
}

void Render(Job& job, std::uint64_t spp) {
  job.spp = spp;
  RunJob(job);
}

}  // namespace

SceneRays RecordRays(const std::string& path, std::size_t max_rays) {
  RenderSettings settings;
  settings.spp = kRecordedSpp;
  Job job = PrepareJob(path, settings);
  const CompiledScene& scene = *job.scene.compiled;
  if (!scene.geometry.instances.empty()) {
    throw InputError(path + ": scenes with instances are not supported by --scene");
  }
  if (scene.geometry.triangles.empty()) throw InputError(path + ": no triangles");
  closest_tap = shadow_tap = {};
  InsertTaps(job.plan);
  const ThreadLimit one(1);
  // Waves are drawn from a render of the usual kind; a quick one says how many there are.
  closest_tap.Start(0);
  shadow_tap.Start(0);
  Render(job, 1);
  for (Tap* tap : {&closest_tap, &shadow_tap}) {
    tap->Start(std::max<std::size_t>(1, tap->rays * kRecordedSpp / max_rays));
  }
  Render(job, kRecordedSpp);
  SceneRays out;
  for (Tap* tap : {&closest_tap, &shadow_tap}) {
    if (!tap->set.rays.empty()) out.sets.push_back(std::move(tap->set));
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const std::string stem = std::filesystem::path(path).stem().string();
  const bool named = stem == "reference" && folder.has_filename();
  out.mesh = FromScene(named ? folder.filename().string() : stem, scene);
  out.scene = job.scene.compiled;
  return out;
}

}  // namespace lanelight::bench
