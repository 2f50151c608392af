// Renders that stop by themselves once the error they state is below a target.
#include <algorithm>
#include <cstdio>

#include "bench/calibrate/calibration.h"
#include "src/base/core/error.h"

namespace lanelight::bench {
namespace {

constexpr double kMinSeconds = 0.1;  // of a render

}  // namespace

void Calibration::Stops(const Job& scene, const std::string& strategy, double target,
                        const Reference& reference, const Deadline& deadline) {
  Job job;
  try {
    job = JobWith(scene, strategy, 0);
  } catch (const InputError& error) {
    fmt::print("{:<48} {}\n", strategy, error.what());
    return;
  }
  job.target.relmse = target;
  // Where the samples cannot tell the error, the target is never reached.
  job.seconds = std::max(kMinSeconds, deadline.Left() / kMinSeeds);
  std::uint64_t reached = 0, stopped = 0, renders = 0;
  double error = 0, samples = 0, checks = 0;
  for (int seed = 1; seed <= options_.seeds; ++seed) {
    if (seed > kMinSeeds && deadline.Over()) break;
    job.seed = static_cast<std::uint64_t>(seed);
    const auto [film, result] = RunJob(job);
    ++renders;
    if (result.stop_reason != StopReason::kTarget) continue;
    const double truth = TrueErrors(film, reference).relmse;
    ++stopped;
    reached += truth < target;
    error += truth;
    samples += double(result.samples) / double(job.window.pixels());
    checks += double(result.num_checks);
  }
  all_reached_ += reached;
  all_stopped_ += stopped;
  fmt::print("{:<48} target {:<8} stopped {}/{}", strategy, target, stopped, renders);
  if (stopped > 0) {
    const Interval fraction = stat::ProportionInterval(reached, stopped, 0.95);
    const double n = double(stopped);
    fmt::print(
        ", reached {:5.1f} % [{:4.1f}, {:5.1f}], overshoot {:.3f}, {:.1f} spp, "
        "{:.1f} looks",
        100 * fraction.value, 100 * fraction.low, 100 * fraction.high, target * n / error,
        samples / n, checks / n);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace lanelight::bench
