#include "src/render/run/sample_rate.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/base/core/stopwatch.h"
#include "src/render/plan/plan_features.h"

namespace lanelight {
namespace {

constexpr int kPasses = 5;
constexpr std::uint64_t kSamples = 2048;

}  // namespace

std::uint64_t SamplesWithin(double seconds, TrainingPass pass) {
  // What has learned nothing yet cannot be rendered with.
  pass.options =
      WithChanges(pass.scene, std::move(pass.options), "roulette=throughput,decide=none");
  const TrainingWork work = MakeTrainingWork(pass.scene, kSamples, 16);
  double rate = INFINITY;
  // The first pass warms up: memory is touched, code and scene are read. Of the others
  // the slowest counts: where others use the machine too, one may have it for itself.
  for (int i = 0; i < kPasses; ++i) {
    const Stopwatch watch;
    RunTrainingPass(pass, work);
    if (i == 0) continue;
    rate = std::min(rate, double(work.samples()) / std::max(watch.Seconds(), 1e-6));
  }
  return std::bit_floor(
      static_cast<std::uint64_t>(std::clamp(rate * seconds, 1.0, 1e15)));
}

}  // namespace lanelight
