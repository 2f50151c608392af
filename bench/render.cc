// Whole renders: Msamples/s and Mrays/s of each scene on one thread and on several,
// scaling, lane occupancy and time per stage. Thread counts alternate, so that a machine
// that changes its clock slows all of them; medians with their spread are printed.
//
//   bench_render SCENE... [--spp N] [--repeats N] [--threads 1,2] [--json FILE]
//
// Where reference-a.exr and reference-b.exr lie beside a scene, the image is compared
// with their mean first: a fast wrong image is not timed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/verify.h"
#include "kernels/simd/target.h"
#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/render/job.h"
#include "src/render/machine_json.h"
#include "src/render/report.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

struct BenchOptions {
  std::vector<std::string> scenes;
  std::uint64_t spp = 64;
  int repeats = 5;
  std::vector<int> threads = {1, 2};
  std::string target, json;
  double tolerance = 0.03;
};

struct Timing {
  int threads = 0;
  std::vector<double> seconds;
  RunResult result;  // of the last repeat: counts are the same in all

  double Median() const { return Quantile(0.5); }
  // Half the distance between the quartiles, relative to the median.
  double Spread() const { return (Quantile(0.75) - Quantile(0.25)) / (2 * Median()); }

 private:
  double Quantile(double q) const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const double at = q * double(sorted.size() - 1);
    const std::size_t low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return sorted[low] + (at - double(low)) * (sorted[high] - sorted[low]);
  }
};

void RunOnce(const Job& job, Timing& timing) {
  const ThreadLimit limit(timing.threads);
  FilmAccumulator film = MakeFilm(job);
  timing.result = RunJob(job, film);
  timing.seconds.push_back(timing.result.seconds);
}

std::vector<Timing> Measure(const Job& job, const BenchOptions& options) {
  std::vector<Timing> timings;
  for (int threads : options.threads) timings.push_back({threads, {}, {}});
  for (Timing& t : timings) {
    RunOnce(job, t);  // warms caches and pages
    t.seconds.clear();
  }
  for (int repeat = 0; repeat < options.repeats; ++repeat) {
    for (Timing& t : timings) RunOnce(job, t);
  }
  return timings;
}

void PrintTimings(const std::vector<Timing>& timings) {
  std::printf("  %-8s %12s %8s %12s %12s %9s\n", "threads", "seconds", "spread",
              "Msamples/s", "Mrays/s", "scaling");
  for (const Timing& t : timings) {
    const double s = t.Median();
    const double rays = double(t.result.rays_closest + t.result.rays_shadow);
    std::printf("  %-8d %12.3f %6.1f %% %12.3f %12.3f %8.2fx\n", t.threads, s,
                100 * t.Spread(), 1e-6 * double(t.result.samples) / s, 1e-6 * rays / s,
                timings.front().Median() / s);
  }
}

void PrintStages(const RunResult& result) {
  double total = 0;
  for (const StageProfile& s : result.stages) total += s.seconds;
  std::printf("  %-24s %10s %8s %10s %8s %9s\n", "stage (first row's threads)", "items M",
              "lanes", "seconds", "share", "ns/item");
  for (const StageProfile& s : result.stages) {
    std::printf("  %-27s %10.2f %6.1f %% %10.3f %6.1f %% %9.2f\n", s.name.c_str(),
                1e-6 * double(s.items), 100 * s.Occupancy(), s.seconds,
                total > 0 ? 100 * s.seconds / total : 0.0,
                s.items ? 1e9 * s.seconds / double(s.items) : 0.0);
  }
}

nlohmann::json TimingsJson(const std::vector<Timing>& timings) {
  nlohmann::json out = nlohmann::json::array();
  for (const Timing& t : timings) {
    nlohmann::json stages = nlohmann::json::array();
    for (const StageProfile& s : t.result.stages) {
      stages.push_back({{"name", s.name},
                        {"items", s.items},
                        {"occupancy", s.Occupancy()},
                        {"seconds", s.seconds}});
    }
    out.push_back({{"threads", t.threads},
                   {"median_seconds", t.Median()},
                   {"all_seconds", t.seconds},
                   {"samples", t.result.samples},
                   {"rays", t.result.rays_closest + t.result.rays_shadow},
                   {"stages", stages}});
  }
  return out;
}

// False if the image is wrong; then nothing is timed.
bool BenchScene(const std::string& scene, const BenchOptions& options,
                nlohmann::json& out) {
  RenderSettings settings;
  settings.spp = options.spp;
  const Job job = PrepareJob(scene, settings);
  std::printf("%s: %dx%d, %llu samples per pixel, %s\n", scene.c_str(),
              job.window.width(), job.window.height(),
              static_cast<unsigned long long>(options.spp), CurrentTarget().c_str());
  std::printf("  wavefront %u paths x %zu bytes; load %.2f s, build %.2f s\n",
              job.plan.wavefront, job.plan.bytes_per_path, job.load_seconds,
              job.build_seconds);
  const Verdict verdict = VerifyAgainstReference(job, scene, options.tolerance);
  std::printf("  %s\n", verdict.text.c_str());
  if (!verdict.good) return false;
  const std::vector<Timing> timings = Measure(job, options);
  PrintTimings(timings);
  PrintStages(timings.front().result);
  std::printf("\n");
  std::fflush(stdout);
  out["scenes"].push_back({{"scene", scene},
                           {"verified", verdict.text},
                           {"spp", options.spp},
                           {"runs", TimingsJson(timings)}});
  return true;
}

BenchOptions ParseArguments(int argc, char** argv, CLI::App& app) {
  BenchOptions options;
  app.add_option("SCENE", options.scenes, "Scenes in the text format of pbrt-v4")
      ->required();
  app.add_option("--spp", options.spp, "Samples per pixel")
      ->check(CLI::Range(std::uint64_t{1}, kMaxSpp));
  app.add_option("--repeats", options.repeats, "Timed runs per thread count")
      ->check(CLI::Range(1, 1000));
  app.add_option("--threads", options.threads, "Thread counts, e.g. 1,2")->delimiter(',');
  app.add_option("--target", options.target, "SIMD target");
  app.add_option("--tolerance", options.tolerance,
                 "Largest relative difference of the channel means from the reference");
  app.add_option("--json", options.json, "Write the figures here too");
  app.parse(argc, argv);
  return options;
}

int Main(int argc, char** argv) {
  CLI::App app("Times whole renders, after verifying their images", "bench_render");
  BenchOptions options;
  try {
    options = ParseArguments(argc, argv, app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  nlohmann::json out = {{"schema", 1}, {"scenes", nlohmann::json::array()}};
  bool good = true;
  try {
    ForceTarget(options.target);
    out["target"] = TargetJson();
    out["machine"] = ToJson(ThisMachine());
    std::printf("%s\n", MachineText(ThisMachine()).c_str());
    for (const std::string& scene : options.scenes)
      good &= BenchScene(scene, options, out);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  if (!options.json.empty()) std::ofstream(options.json) << out.dump(2) << '\n';
  return good ? 0 : 1;
}

}  // namespace
}  // namespace lanelight

int main(int argc, char** argv) { return lanelight::Main(argc, argv); }
