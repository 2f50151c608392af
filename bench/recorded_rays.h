// The rays of a render, recorded before the stages of a kind of shapes, and traced again
// by our kernels and by Embree.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "bench/cpu_clock.h"
#include "bench/intersect/embree_calls.h"
#include "bench/intersect/ray_sets.h"
#include "bench/series.h"
#include "kernels/stages.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/render/job/job.h"

namespace lanelight::bench {

/// Stands between the driver and a kernel; kernels are bare functions.
struct RayTap {
  StageFn kernel = nullptr;
  RaySet set;
};
inline RayTap closest_rays, shadow_rays;
inline std::size_t max_rays = std::size_t{1} << 20;

inline float TimeOf(const PathColumns& p, std::uint32_t i) {
  return p.time == nullptr ? 0 : p.time[i];
}
inline TestRay ClosestOf(const PathColumns& p, std::uint32_t i) {
  TestRay ray = {{p.o_x[i], p.o_y[i], p.o_z[i]}, {p.d_x[i], p.d_y[i], p.d_z[i]}};
  ray.time = TimeOf(p, i);
  return ray;
}
inline TestRay ShadowOf(const PathColumns& p, std::uint32_t i) {
  const Vec3f d{p.ls_x[i], p.ls_y[i], p.ls_z[i]}, n{p.ng_x[i], p.ng_y[i], p.ng_z[i]};
  const Vec3f from{p.p_x[i], p.p_y[i], p.p_z[i]};
  TestRay ray = {from + std::copysign(p.p_error[i], Dot(n, d)) * n, d, p.ls_distance[i]};
  ray.time = TimeOf(p, i);
  return ray;
}

template <RayTap& kTap, QueueId kQueue,
          TestRay (&kRay)(const PathColumns&, std::uint32_t)>
void RecordQueue(Wave& wave) {
  const Queue& queue = wave.queue(kQueue);
  if (queue.size > 0 && kTap.set.rays.size() < max_rays) {
    for (std::uint32_t i = 0; i < queue.size; ++i) {
      kTap.set.rays.push_back(kRay(wave.path, queue.items[i]));
    }
    kTap.set.waves.push_back(queue.size);
  }
  kTap.kernel(wave);
}

/// Renders a scene with 4 samples a pixel by one thread, and records what stands in the
/// queues before the stages intersect_SHAPES and shadow_SHAPES.
inline Job RecordJob(const std::string& path, const std::string& shapes) {
  RenderSettings settings;
  settings.spp = 4;
  Job job = PrepareJob(path, settings);
  for (PlannedStage& planned : job.plan.phases[0].stages) {
    const std::string name = planned.stage.name;
    if (name == "intersect_" + shapes) {
      closest_rays = {planned.kernel, {"closest", false, {}, {}}};
      planned.kernel = RecordQueue<closest_rays, QueueId::kActive, ClosestOf>;
    } else if (name == "shadow_" + shapes) {
      shadow_rays = {planned.kernel, {"shadow", true, {}, {}}};
      planned.kernel = RecordQueue<shadow_rays, QueueId::kShadow, ShadowOf>;
    }
  }
  const ThreadLimit one(1);
  RunJob(job);
  return job;
}

/// Seconds of processor time, and the hits.
inline double TraceOurs(const CompiledScene& scene, StageFn kernel, const RaySet& set,
                        std::vector<BenchHit>& hits) {
  WaveFixture fixture(scene, static_cast<std::uint32_t>(LargestWave(set, 1)));
  double seconds = 0;
  hits.assign(set.rays.size(), {});
  ForEachWave(set, 1, [&](std::size_t begin, std::size_t end) {
    const std::vector<TestRay> part(set.rays.begin() + static_cast<std::ptrdiff_t>(begin),
                                    set.rays.begin() + static_cast<std::ptrdiff_t>(end));
    set.shadow ? fixture.SetShadowRays(part) : fixture.SetRays(part);
    const CpuTimer timer;
    kernel(fixture.wave);
    seconds += timer.Seconds();
    const PathColumns& p = fixture.wave.path;
    for (std::size_t i = begin; i < end && !set.shadow; ++i) hits[i].t = p.t[i - begin];
    const Queue& open = fixture.wave.queue(QueueId::kShadow);
    for (std::uint32_t k = 0; set.shadow && k < open.size; ++k) {
      hits[begin + open.items[k]].t = INFINITY;
    }
  });
  return seconds;
}

inline double TraceEmbree(RTCScene scene, EmbreeCall call, const RaySet& set,
                          std::vector<BenchHit>& hits) {
  EmbreeWave wave(call, set.shadow, LargestWave(set, 1));
  double seconds = 0;
  hits.assign(set.rays.size(), {});
  ForEachWave(set, 1, [&](std::size_t begin, std::size_t end) {
    wave.CopyRays(&set.rays[begin], end - begin);
    const CpuTimer timer;
    wave.Trace(scene, false);
    seconds += timer.Seconds();
    wave.Unpack(&hits[begin]);
  });
  return seconds;
}

/// Rays of which both say the same, within a thousandth of the distance.
inline double Agreement(const std::vector<BenchHit>& a, const std::vector<BenchHit>& b) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool miss = std::isinf(a[i].t) && std::isinf(b[i].t);
    same += miss || std::abs(a[i].t - b[i].t) <= 1e-3f * std::abs(a[i].t);
  }
  return static_cast<double>(same) / static_cast<double>(a.size());
}

/// In turns, wave by wave: prints millions of rays a second, median of the rounds. Embree
/// has one ray a call, and 16.
inline void Measure(const CompiledScene& scene, RTCScene peer, const RayTap& tap,
                    int rounds) {
  const RaySet& set = tap.set;
  std::vector<BenchHit> ours, theirs;
  Series of_ours, of_one, of_sixteen;
  const double rays = 1e-6 * static_cast<double>(set.rays.size());
  for (int i = 0; i < rounds; ++i) {
    of_ours.Add(rays / TraceOurs(scene, tap.kernel, set, ours));
    of_one.Add(rays / TraceEmbree(peer, EmbreeCall::kOne, set, theirs));
    of_sixteen.Add(rays / TraceEmbree(peer, EmbreeCall::kSixteen, set, theirs));
  }
  const auto shown = [](const Series& s) {
    return fmt::format("{:.2f} [{:.2f}, {:.2f}]", s.Median(), s.Min(), s.Max());
  };
  fmt::print(
      "{:8} {:5.2f} M rays  ours {}  Embree, one {}  16 {} Mray/s  same {:.2f} %\n",
      set.name, rays, shown(of_ours), shown(of_one), shown(of_sixteen),
      100 * Agreement(ours, theirs));
}

/// Of both kinds, as far as there were any.
inline void MeasureAll(const CompiledScene& scene, RTCScene peer, int rounds) {
  for (const RayTap* tap : {&closest_rays, &shadow_rays}) {
    if (!tap->set.rays.empty()) Measure(scene, peer, *tap, rounds);
  }
}

/// main() of a program that takes a scene, and at most how many rays and rounds.
inline int RunRecorded(int argc, char** argv, const char* name,
                       void (*run)(const std::string& scene, int rounds)) {
  if (argc < 2 || argc > 4) {
    fmt::print(stderr, "usage: {} SCENE [rays] [rounds]\n", name);
    return 2;
  }
  try {
    if (argc > 2) max_rays = std::strtoull(argv[2], nullptr, 10);
    run(argv[1], argc > 3 ? std::atoi(argv[3]) : 5);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace lanelight::bench
