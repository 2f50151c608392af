#include "bench/cpu_clock.h"
#include "bench/intersect/tracer.h"
#include "kernels/stages.h"
#include "tests/support/test_target.h"

namespace lanelight::bench {
namespace {

void CopyHits(const WaveFixture& f, bool shadow, std::size_t count, BenchHit* out) {
  const PathColumns& p = f.wave.path;
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = shadow ? BenchHit{0, 0} : BenchHit{p.t[i], p.prim[i]};
  }
  if (!shadow) return;
  const Queue& open = f.wave.queues[static_cast<int>(QueueId::kShadow)];
  for (std::uint32_t i = 0; i < open.size; ++i) out[open.items[i]].t = INFINITY;
}

}  // namespace

WaveFixture& OurTracer::Fixture(const RaySet& set) {
  const auto largest =
      static_cast<std::uint32_t>(LargestWave(set, static_cast<std::size_t>(wave_)));
  if (!fixture_ || fixture_->wave.capacity < largest) {
    fixture_ = std::make_unique<WaveFixture>(scene_, largest);
  }
  return *fixture_;
}

double OurTracer::Trace(const RaySet& set, std::vector<BenchHit>* hits) {
  WaveFixture& f = Fixture(set);
  // As a render does: resolved once, for a scene of opaque world triangles.
  const Stage stage =
      (set.shadow ? ShadowTrianglesStage : IntersectTrianglesStage)(TestTarget());
  const StageFn kernel = stage.resolve({});
  if (hits) hits->resize(set.rays.size());
  double seconds = 0;
  ForEachWave(
      set, static_cast<std::size_t>(wave_), [&](std::size_t begin, std::size_t end) {
        const std::vector<TestRay> part(set.rays.begin() + begin, set.rays.begin() + end);
        if (set.shadow) {
          f.SetShadowRays(part);
        } else {
          f.SetRays(part);
        }
        const CpuTimer timer;
        kernel(f.wave);
        seconds += timer.Seconds();
        if (hits) CopyHits(f, set.shadow, end - begin, hits->data() + begin);
      });
  return seconds;
}

}  // namespace lanelight::bench
