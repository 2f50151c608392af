// Rays among the curves of a scene, beside Embree's flat Bezier curves.
//
//   bench_curves SCENE [rays] [rounds]
//
// The rays are those of a render of one thread, 4 samples a pixel: what stands in the
// queues before the stages of curves, in the order in which they are traced. Both take
// them in turns, wave by wave; processor time, median of the rounds. Embree has one ray a
// call, and 16 rays a call, quality high, its own tessellation rate (4).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "bench/cpu_clock.h"
#include "bench/intersect/embree_calls.h"
#include "bench/intersect/ray_sets.h"
#include "bench/series.h"
#include "kernels/stages.h"
#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/render/job.h"

namespace lanelight::bench {
namespace {

// Stands between the driver and a kernel of curves; kernels are bare functions.
struct CurveTap {
  StageFn kernel = nullptr;
  RaySet set;
};
CurveTap closest_curves, shadow_curves;
std::size_t most_rays = 0;

TestRay ClosestOf(const PathColumns& p, std::uint32_t i) {
  return {{p.o_x[i], p.o_y[i], p.o_z[i]}, {p.d_x[i], p.d_y[i], p.d_z[i]}};
}
TestRay ShadowOf(const PathColumns& p, std::uint32_t i) {
  const Vec3f d{p.ls_x[i], p.ls_y[i], p.ls_z[i]}, n{p.ng_x[i], p.ng_y[i], p.ng_z[i]};
  const Vec3f from{p.p_x[i], p.p_y[i], p.p_z[i]};
  return {from + std::copysign(p.p_error[i], Dot(n, d)) * n, d, p.ls_distance[i]};
}

template <CurveTap& kTap, QueueId kQueue,
          TestRay (&kRay)(const PathColumns&, std::uint32_t)>
void RecordCurves(Wave& wave) {
  const Queue& queue = wave.queue(kQueue);
  if (queue.size > 0 && kTap.set.rays.size() < most_rays) {
    for (std::uint32_t i = 0; i < queue.size; ++i) {
      kTap.set.rays.push_back(kRay(wave.path, queue.items[i]));
    }
    kTap.set.waves.push_back(queue.size);
  }
  kTap.kernel(wave);
}

Job RecordJob(const std::string& path) {
  RenderSettings settings;
  settings.spp = 4;
  Job job = PrepareJob(path, settings);
  if (job.scene.geometry.curves.empty()) throw InputError(path + ": no curves");
  for (PlannedStage& planned : job.plan.stages) {
    const std::string name = planned.stage.name;
    if (name == "intersect_curves") {
      closest_curves = {planned.kernel, {"closest", false, {}, {}}};
      planned.kernel = RecordCurves<closest_curves, QueueId::kActive, ClosestOf>;
    } else if (name == "shadow_curves") {
      shadow_curves = {planned.kernel, {"shadow", true, {}, {}}};
      planned.kernel = RecordCurves<shadow_curves, QueueId::kShadow, ShadowOf>;
    }
  }
  const ThreadLimit one(1);
  RunJob(job);
  return job;
}

RTCScene EmbreeCurves(RTCDevice device, const Geometry& geometry) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_FLAT_BEZIER_CURVE);
  const std::size_t n = geometry.curves.size();
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(
      g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, 4 * n));
  auto* first = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, n));
  for (std::size_t i = 0; i < n; ++i) {
    const CurveRecord& curve = geometry.curves[i];
    first[i] = static_cast<unsigned>(4 * i);
    for (int k = 0; k < 4; ++k, points += 4) {
      std::copy(curve.p[k], curve.p[k] + 3, points);
      const float share = static_cast<float>(k) / 3;
      points[3] = 0.5f * ((1 - share) * curve.width[0] + share * curve.width[1]);
    }
  }
  rtcCommitGeometry(g);
  rtcAttachGeometry(scene, g);
  rtcReleaseGeometry(g);
  rtcCommitScene(scene);
  return scene;
}

double TraceOurs(const CompiledScene& scene, const RaySet& set,
                 std::vector<BenchHit>& hits) {
  WaveFixture fixture(scene, static_cast<std::uint32_t>(LargestWave(set, 1)));
  const StageFn kernel =
      (set.shadow ? ShadowCurvesStage : IntersectCurvesStage)(TestTarget()).resolve({});
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

double TraceEmbree(RTCScene scene, EmbreeCall call, const RaySet& set,
                   std::vector<BenchHit>& hits) {
  EmbreeWave wave(call, set.shadow, LargestWave(set, 1));
  double seconds = 0;
  hits.assign(set.rays.size(), {});
  ForEachWave(set, 1, [&](std::size_t begin, std::size_t end) {
    wave.Pack(&set.rays[begin], end - begin);
    const CpuTimer timer;
    wave.Trace(scene, false);
    seconds += timer.Seconds();
    wave.Unpack(&hits[begin]);
  });
  return seconds;
}

// Rays of which both say the same, within a thousandth of the distance.
double Agreement(const std::vector<BenchHit>& a, const std::vector<BenchHit>& b) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool miss = std::isinf(a[i].t) && std::isinf(b[i].t);
    same += miss || std::abs(a[i].t - b[i].t) <= 1e-3f * std::abs(a[i].t);
  }
  return static_cast<double>(same) / static_cast<double>(a.size());
}

void Measure(const CompiledScene& scene, RTCScene peer, const RaySet& set, int rounds) {
  std::vector<BenchHit> ours, theirs;
  Series of_ours, of_one, of_sixteen;
  const double rays = 1e-6 * static_cast<double>(set.rays.size());
  for (int i = 0; i < rounds; ++i) {
    of_ours.Add(rays / TraceOurs(scene, set, ours));
    of_one.Add(rays / TraceEmbree(peer, EmbreeCall::kOne, set, theirs));
    of_sixteen.Add(rays / TraceEmbree(peer, EmbreeCall::kSixteen, set, theirs));
  }
  const auto shown = [](const Series& s) {
    return fmt::format("{:.2f} [{:.2f}, {:.2f}]", s.Median(), s.Least(), s.Most());
  };
  fmt::print(
      "{:8} {:5.2f} M rays  ours {}  Embree, one {}  16 {} Mray/s  same {:.2f} %\n",
      set.name, rays, shown(of_ours), shown(of_one), shown(of_sixteen),
      100 * Agreement(ours, theirs));
}

void RunCurveBench(const std::string& path, int rounds) {
  const Job job = RecordJob(path);
  const Geometry& geometry = job.scene.geometry;
  fmt::print("{} curves, {:.1f} bytes of trees for each\n", geometry.curves.size(),
             static_cast<double>(job.scene.accel.Bytes()) /
                 static_cast<double>(geometry.curves.size()));
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene peer = EmbreeCurves(device, geometry);
  for (const CurveTap* tap : {&closest_curves, &shadow_curves}) {
    if (!tap->set.rays.empty()) Measure(job.scene, peer, tap->set, rounds);
  }
  rtcReleaseScene(peer);
  rtcReleaseDevice(device);
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    fmt::print(stderr, "usage: bench_curves SCENE [rays] [rounds]\n");
    return 2;
  }
  try {
    lanelight::bench::most_rays =
        argc > 2 ? std::strtoull(argv[2], nullptr, 10) : std::size_t{1} << 20;
    lanelight::bench::RunCurveBench(argv[1], argc > 3 ? std::atoi(argv[3]) : 5);
  } catch (const lanelight::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
