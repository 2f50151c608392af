// How well renders know their own error: how often the true error lies inside the
// interval that a render states, over many seeds.
//
//   bench_calibrate SCENE... [--seeds N] [--spp 16 64 256] [--resolution WxH]
//                   [--strategies 'A;B;...'] [--reference-spp N] [--target-relmse X]
//
// The truth comes from a reference of independent samples with a seed of its own, whose
// own error is subtracted. "ratio" is the mean true error over the mean estimate, "width"
// the mean of half the logarithm of high / low. With --target-relmse renders stop by
// themselves: "reached" counts those whose true error is below the target, "overshoot" is
// the mean target over the mean error.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/render/job.h"
#include "src/stat/interval.h"
#include "src/image/colors.h"
#include "src/study/errors.h"
#include "src/estimate/estimate.h"
#include "src/study/options.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kReferenceSeed = 0x5eed5eed;  // renders have 1, 2, ...

struct CalibrateOptions {
  std::vector<std::string> scenes;
  std::string strategies = "points=independent;points=sobol", resolution = "64x48";
  std::vector<std::uint64_t> spp = {16, 64, 256};
  std::uint64_t reference_spp = 16384;
  std::vector<double> targets;
  int seeds = 100, threads = 0;
};

// Intervals that were checked against the truth.
struct Coverage {
  std::uint64_t total = 0, inside = 0, below = 0;
  double truth = 0, estimate = 0, width = 0;

  void Add(double true_error, const Interval& stated) {
    ++total;
    inside += stated.Contains(true_error);
    below += true_error < stated.low;
    truth += true_error;
    estimate += stated.value;
    if (stated.low > 0) width += std::log(stated.high / stated.low) / 2;
  }
  void Add(const Coverage& other) {
    total += other.total;
    inside += other.inside;
    below += other.below;
  }
  std::string Text() const {
    const Interval share = stat::ProportionInterval(inside, total, 0.95);
    const std::string text =
        fmt::format("{:5.1f} % [{:4.1f}, {:5.1f}] {:>4} {:>4}", 100 * share.value,
                    100 * share.low, 100 * share.high, below, total - inside - below);
    if (!(estimate > 0)) return text;  // of all rows together
    return text + fmt::format(" {:>7.3f} {:>7.3f} {:>9.3g}", truth / estimate,
                              width / double(total), estimate / double(total));
  }
};

void UseStrategy(Job& job, const std::string& text, std::uint64_t spp) {
  Strategy strategy;
  ApplyStrategy(text, {std::make_shared<const std::string>("--strategies"), 0, 0},
                strategy);
  job.spp = spp;
  SetStrategy(job, strategy);
}

Measurement TrueErrors(const FilmAccumulator& film, const Reference& reference) {
  Measurement m;
  MeasureErrors(FilmColors(film), reference, m);
  return m;
}

void PrintRow(const std::string& name, const std::string& error, const Coverage& c) {
  fmt::print("{:<58} {:<7} {}\n", name, error, c.Text());
  std::fflush(stdout);
}

class Calibration {
 public:
  explicit Calibration(const CalibrateOptions& options) : options_(options) {}

  void Scene(const std::string& path) {
    RenderSettings settings;
    int width = 0, height = 0;
    if (std::sscanf(options_.resolution.c_str(), "%dx%d", &width, &height) != 2) {
      throw InputError("--resolution " + options_.resolution + " is not WxH");
    }
    settings.resolution = {width, height};
    settings.spp = options_.reference_spp;
    Job job = PrepareJob(path, settings);
    const Reference reference =
        RenderReference(job, options_.reference_spp, kReferenceSeed, {}, nullptr);
    fmt::print("\n{}, {}\n{:<58} {:<7} {:>21} {:>4} {:>4} {:>7} {:>7} {:>9}\n", path,
               options_.resolution, "", "", "true inside", "low", "high", "ratio",
               "width", "estimate");
    for (const std::string& strategy : SplitStrategies(options_.strategies)) {
      for (double target : options_.targets) Stop(job, strategy, target, reference);
      if (!options_.targets.empty()) continue;
      for (std::uint64_t spp : options_.spp) Row(job, strategy, spp, reference);
    }
  }
  void Finish() const {
    fmt::print("\n");
    if (!options_.targets.empty()) {
      fmt::print("reached by {} of {}\n", all_reached_, all_stopped_);
      return;
    }
    PrintRow("all", "relmse", all_relmse_);
    PrintRow("all", "rmse", all_rmse_);
  }

 private:
  void Row(Job& job, const std::string& strategy, std::uint64_t spp,
           const Reference& reference) {
    UseStrategy(job, strategy, spp);
    Coverage relmse, rmse;
    for (int seed = 1; seed <= options_.seeds; ++seed) {
      job.seed = static_cast<std::uint64_t>(seed);
      FilmAccumulator film = MakeFilm(job);
      RunJob(job, film);
      const Measurement truth = TrueErrors(film, reference);
      const ErrorEstimate stated = EstimateError(film);
      relmse.Add(truth.relmse, stated.relmse);
      rmse.Add(std::sqrt(std::max(0.0, truth.mse)), stated.rmse);
    }
    const std::string name = fmt::format("{}, {} spp", strategy, spp);
    PrintRow(name, "relmse", relmse);
    PrintRow(name, "rmse", rmse);
    all_relmse_.Add(relmse);
    all_rmse_.Add(rmse);
  }

  // Renders that stop by themselves.
  void Stop(Job& job, const std::string& strategy, double target,
            const Reference& reference) {
    UseStrategy(job, strategy, 0);
    job.target.relmse = target;
    std::uint64_t reached = 0;
    double error = 0, samples = 0, looks = 0;
    for (int seed = 1; seed <= options_.seeds; ++seed) {
      job.seed = static_cast<std::uint64_t>(seed);
      FilmAccumulator film = MakeFilm(job);
      const RunResult result = RunJob(job, film);
      const double truth = TrueErrors(film, reference).relmse;
      reached += truth < target;
      error += truth / options_.seeds;
      samples += double(result.samples) / double(job.window.pixels()) / options_.seeds;
      looks += double(result.looks) / options_.seeds;
    }
    const auto total = static_cast<std::uint64_t>(options_.seeds);
    const Interval share = stat::ProportionInterval(reached, total, 0.95);
    fmt::print(
        "{:<40} target {:<8} reached {:5.1f} % [{:4.1f}, {:5.1f}], overshoot {:.3f}, "
        "{:.1f} spp, {:.1f} looks\n",
        strategy, target, 100 * share.value, 100 * share.low, 100 * share.high,
        target / error, samples, looks);
    std::fflush(stdout);
    all_reached_ += reached;
    all_stopped_ += total;
  }

  const CalibrateOptions& options_;
  std::uint64_t all_reached_ = 0, all_stopped_ = 0;
  Coverage all_relmse_, all_rmse_;
};

int Main(int argc, char** argv) {
  CalibrateOptions options;
  CLI::App app("How often the true error lies inside the interval a render states");
  app.add_option("SCENES", options.scenes, "pbrt scenes")->required();
  app.add_option("--seeds", options.seeds, "Renders of each")
      ->check(CLI::Range(1, 100000));
  app.add_option("--spp", options.spp, "Samples per pixel");
  app.add_option("--resolution", options.resolution, "Size of the images, WxH");
  app.add_option("--strategies", options.strategies, "List 'A;B;...'");
  app.add_option("--target-relmse", options.targets, "Let renders stop by themselves");
  app.add_option("--reference-spp", options.reference_spp, "Samples of the reference");
  app.add_option("--threads", options.threads, "Threads")->check(CLI::Range(1, 1024));
  CLI11_PARSE(app, argc, argv);
  const ThreadLimit threads(options.threads);
  Calibration calibration(options);
  for (const std::string& scene : options.scenes) calibration.Scene(scene);
  calibration.Finish();
  return 0;
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) {
  try {
    return lanelight::Main(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_calibrate: %s\n", error.what());
    return 1;
  }
}
