#include "src/wavefront/pilot_pass.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "src/core/check.h"
#include "src/core/parallel.h"
#include "src/strategy/tables.h"
#include "src/wavefront/copies.h"
#include "src/wavefront/drive.h"
#include "src/wavefront/plan_features.h"
#include "src/wavefront/tiles.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kPixelsPerTask = 1024;
constexpr int kRecordPlanes = 3 * kPilotVertices + 5;

PilotRecord ReadRecord(const float* values, std::size_t stride, std::size_t i) {
  PilotRecord record;
  const float* plane = values + kColorPlanes * stride + i;
  const auto next = [&] {
    const float value = *plane;
    plane += stride;
    return value;
  };
  for (PilotRecord::Vertex& v : record.vertices) {
    v.cell = std::bit_cast<std::uint32_t>(next());
    v.at = next();
    v.got = next();
  }
  record.end = next();
  record.depth = next();
  for (float& risk : record.risk) risk = next();
  return record;
}

class Pass {
 public:
  Pass(const CompiledScene& scene, const PlanOptions& options, const RunParameters& run,
       const std::vector<std::uint32_t>& pixels)
      : scene_(scene),
        plan_(MakePlan(scene, options)),
        run_(Parameters(scene, plan_, run)),
        pixels_(pixels),
        copies_(plan_.features.Has(Feature::kSplitting) ? kMostCopies : 1),
        records_(options.pilot == PilotPass::kRecord) {
    wavefronts_.resize(static_cast<std::size_t>(MaxThreads()) + 1);
    samples_.colors.resize(pixels.size() * kPilotSpp);
    if (records_) samples_.records.resize(samples_.colors.size());
  }

  PilotSamples Run() {
    const std::size_t tasks = (pixels_.size() + kPixelsPerTask - 1) / kPixelsPerTask;
    ParallelFor(tasks, [&](std::size_t task) { RunTask(task * kPixelsPerTask); });
    for (const auto& wavefront : wavefronts_) {
      if (!wavefront) continue;
      samples_.rays_closest += wavefront->wave().rays_closest;
      samples_.rays_shadow += wavefront->wave().rays_shadow;
    }
    return std::move(samples_);
  }

 private:
  static RunParameters Parameters(const CompiledScene& scene, const Plan& plan,
                                  RunParameters run) {
    const Strategy strategy = PlannedStrategy(scene, plan.options);
    run.seed ^= 0x5bd1e995u;  // apart from the image's
    run.spp = kPilotSpp;
    run.points = MakePointsParameters(strategy.points, 1);
    run.pairs = MakePairParameters(strategy);
    run.roulette = MakeRouletteParameters(strategy);
    run.features = plan.features;
    return run;
  }

  void RunTask(std::size_t first) {
    auto& wavefront = wavefronts_[static_cast<std::size_t>(ThreadIndex())];
    if (!wavefront) wavefront = std::make_unique<Wavefront>(scene_, plan_, run_);
    TileWork work;
    work.pixels = pixels_.data() + first;
    work.num_pixels = static_cast<std::uint32_t>(
        std::min<std::size_t>(kPixelsPerTask, pixels_.size() - first));
    work.samples = kPilotSpp;
    const std::uint32_t count = work.num_pixels * kPilotSpp, rows = count * copies_;
    const int planes = kColorPlanes + (records_ ? kRecordPlanes : 0);
    std::vector<float> values(std::size_t{rows} * static_cast<std::size_t>(planes));
    std::vector<StageCounters> untimed;
    Drive(*wavefront, plan_, work, {values.data(), rows}, untimed);
    if (copies_ > 1) FoldCopies(values.data(), rows, planes, kColorPlanes);
    for (std::size_t i = 0; i < count; ++i) {
      samples_.colors[first * kPilotSpp + i] = {values[i], values[count + i],
                                                values[2 * count + i]};
      if (!records_) continue;
      samples_.records[first * kPilotSpp + i] = ReadRecord(values.data(), count, i);
    }
  }

  const CompiledScene& scene_;
  const Plan plan_;
  const RunParameters run_;
  const std::vector<std::uint32_t>& pixels_;
  const std::uint32_t copies_;
  const bool records_;
  std::vector<std::unique_ptr<Wavefront>> wavefronts_;
  PilotSamples samples_;
};

}  // namespace

std::vector<std::uint32_t> PilotPixels(const CompiledScene& scene, std::uint64_t count) {
  std::vector<std::uint32_t> all;
  // Blocks of neighbours first, so that an even choice of them is even in both axes.
  TilePixels(RenderedPixels(scene.film), scene.film.width, &all);
  if (count >= all.size()) return all;
  std::vector<std::uint32_t> pixels;
  std::uint64_t jitter = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    // One pixel of each of `count` equal stretches, at a place of its own in each.
    const std::uint64_t begin = i * all.size() / count;
    const std::uint64_t end = (i + 1) * all.size() / count;
    jitter = jitter * 6364136223846793005u + 1442695040888963407u;
    pixels.push_back(all[begin + (jitter >> 33) % (end - begin)]);
  }
  return pixels;
}

PilotSamples RunPilotPass(const CompiledScene& scene, const PlanOptions& options,
                          const RunParameters& run,
                          const std::vector<std::uint32_t>& pixels) {
  return Pass(scene, options, run, pixels).Run();
}

}  // namespace lanelight
