#include "src/wavefront/sample_rate.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "src/wavefront/training_pass.h"

namespace lanelight {
namespace {

constexpr int kPasses = 5;
constexpr std::uint64_t kSamples = 2048;

}  // namespace

std::uint64_t SamplesWithin(double seconds, const CompiledScene& scene,
                            const PlanOptions& options, const RunParameters& run,
                            const TaskWatcher* watcher) {
  PlanOptions simple = options;
  simple.auxiliary = Auxiliary::kNone;
  simple.training = FeatureSet{};
  // What has learned nothing yet cannot be rendered with.
  simple.changes = "roulette=throughput,guiding=none,decide=none";
  double rate = INFINITY;
  // The first pass warms up: memory is touched, code and scene are read. Of the others
  // the slowest counts: where others use the machine too, one may have it for itself.
  for (int pass = 0; pass < kPasses; ++pass) {
    const TrainingWork work = MakeTrainingWork(scene, kSamples, 16);
    const auto start = std::chrono::steady_clock::now();
    RunTrainingPass(scene, simple, run, work, watcher);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (pass == 0) continue;
    rate = std::min(rate, double(work.samples()) / std::max(taken.count(), 1e-6));
  }
  return std::bit_floor(
      static_cast<std::uint64_t>(std::clamp(rate * seconds, 1.0, 1e15)));
}

}  // namespace lanelight
