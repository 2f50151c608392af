// Measures the overhead of profiling: renders without it, with it, and with a trace, in
// turns, on one thread, by processor time. Prints the median and quartiles of the ratios
// of neighbours in time.
//
//   bench_profile SCENE... [--spp N] [--repeats N]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "src/base/core/clock.h"
#include "src/base/core/error.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/render/job/job.h"

namespace lanelight {
namespace {

struct BenchOptions {
  std::vector<std::string> scenes;
  std::uint64_t spp = 16;
  int repeats = 21;
};

enum Mode { kOff, kOn, kTrace, kModes };
constexpr const char* kNames[] = {"off", "on", "on, trace"};

double CpuSeconds(const Job& job, Mode mode) {
  FilmAccumulator film = MakeFilm(job);
  RunOptions options = RunOptionsOf(job);
  options.profile = mode != kOff;
  options.profiling.counters = options.profiling.bounces = mode != kOff;
  if (mode == kTrace) options.profiling.trace_events = 1 << 17;
  const double start = ProcessCpuSeconds();
  Run(job.scene, job.plan, options, film);
  return ProcessCpuSeconds() - start;
}

double Quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * double(values.size() - 1) + 0.5)];
}

void Measure(const std::string& scene, const BenchOptions& options) {
  RenderSettings settings;
  settings.spp = options.spp;
  const Job job = PrepareJob(scene, settings);
  CpuSeconds(job, kTrace);  // warms up
  std::vector<double> seconds[kModes], ratios[kModes];
  for (int i = 0; i < options.repeats; ++i) {
    double now[kModes];
    // The order turns, so that no mode is always the first.
    for (int k = 0; k < kModes; ++k) {
      const Mode mode = static_cast<Mode>((k + i) % kModes);
      now[mode] = CpuSeconds(job, mode);
    }
    for (int mode = 0; mode < kModes; ++mode) {
      seconds[mode].push_back(now[mode]);
      ratios[mode].push_back(now[mode] / now[kOff] - 1);
    }
  }
  std::printf("%s, %llu samples per pixel\n", scene.c_str(),
              static_cast<unsigned long long>(options.spp));
  for (int mode = 0; mode < kModes; ++mode) {
    std::printf("  %-10s %8.1f ms  %+6.2f %%  [%+.2f, %+.2f]\n", kNames[mode],
                1e3 * Quantile(seconds[mode], 0.5), 100 * Quantile(ratios[mode], 0.5),
                100 * Quantile(ratios[mode], 0.25), 100 * Quantile(ratios[mode], 0.75));
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) {
  lanelight::BenchOptions options;
  CLI::App app("What profiling costs");
  app.add_option("SCENE", options.scenes)->required();
  app.add_option("--spp", options.spp)->check(CLI::Range(1, 1 << 20));
  app.add_option("--repeats", options.repeats)->check(CLI::Range(1, 10000));
  CLI11_PARSE(app, argc, argv);
  const lanelight::ThreadLimit threads(1);
  std::printf("%s\n", lanelight::MachineText(lanelight::ThisMachine()).c_str());
  try {
    for (const std::string& scene : options.scenes) lanelight::Measure(scene, options);
  } catch (const lanelight::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
