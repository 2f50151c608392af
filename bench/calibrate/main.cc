// Measures how often the true error lies inside the interval that a render states, over
// many seeds.
//
//   bench_calibrate [SCENE...] [--minutes M] [--seeds N] [--spp 16 64 256 1024]
//                   [--resolutions 48x48 96x96] [--strategies 'A;B;...']
//                   [--every-strategy] [--least-seeds N] [--reference-spp N]
//                   [--target-relmse X...]
//
// Without scenes, renders all of the project's and of $LANELIGHT_SCENES. All combinations
// share the time evenly: as many seeds of each as fit, at least ten (--least-seeds). If
// all of --seeds fit, the result does not depend on the machine. The truth comes from a
// reference of Sobol' points with its own seed, which takes a quarter of a scene's time;
// its own error is subtracted. "ref" is that error over the true one of a render, and
// should be small.
//
// "refused" are renders whose samples cannot tell how large the error is; "at least" how
// many of their lower ends held. "ratio" is the mean true error over the mean estimate,
// "width" the mean of half the logarithm of high / low. With --target-relmse renders stop
// by themselves: "stopped" counts those that did before 16384 samples per pixel,
// "reached" those of them whose true error is below the target, "overshoot" is the mean
// target over the mean error.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/calibrate/calibration.h"
#include "bench/calibrate/every_strategy.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"

namespace lanelight::bench {
namespace {

int Main(int argc, char** argv) {
  CalibrateOptions options;
  bool every = false;
  CLI::App app("How often the true error lies inside the interval a render states");
  app.option_defaults()->always_capture_default();
  app.add_option("SCENES", options.scenes, "pbrt scenes; none: all there are");
  app.add_option("--minutes", options.minutes, "Time for everything")
      ->check(CLI::PositiveNumber);
  app.add_option("--seeds", options.seeds, "Most renders of each")
      ->check(CLI::Range(1, 100000));
  app.add_option("--least-seeds", options.min_seeds, "Fewest renders of each")
      ->check(CLI::Range(1, 100000));
  app.add_option("--spp", options.spp, "Samples per pixel");
  app.add_option("--resolutions", options.resolutions, "Sizes of the images, WxH");
  app.add_option("--strategies", options.strategies, "List 'A;B;...'")->delimiter(';');
  app.add_flag("--every-strategy", every, "All choices of all axes, and the presets");
  app.add_option("--target-relmse", options.targets, "Let renders stop by themselves");
  app.add_option("--reference-spp", options.reference_spp,
                 "Samples of the reference; 0: what the time allows");
  app.add_option("--threads", options.threads, "Threads")->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  if (every) options.strategies = EveryStrategy();
  if (options.scenes.empty()) options.scenes = AllScenes();
  for (const std::string& text : options.resolutions) ParseResolution(text);
  const ThreadLimit threads(options.threads);
  Calibration(options).Run();
  return 0;
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  try {
    return lanelight::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_calibrate: %s\n", error.what());
    return 1;
  }
}
