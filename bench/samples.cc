// Huge numbers of samples on a few pixels: processor time per sample, which must not
// grow, and the peak of memory, which must not either.
//
//   bench_samples [SCENE] [--spp 100000,1000000,10000000] [--crop 4] [--repeats N]
//
// One thread, unless --threads says otherwise. Numbers of samples take turns.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <stdexcept>

#include "bench/resident.h"
#include "bench/series.h"
#include "src/base/core/clock.h"
#include "src/base/core/machine_info.h"
#include "src/base/core/parallel.h"
#include "src/render/job/job.h"

namespace lanelight::bench {
namespace {

struct Flags {
  std::string scene = "scenes/cornell-box.pbrt";
  std::vector<std::uint64_t> spp = {100'000, 1'000'000, 10'000'000};
  int crop = 4, repeats = 3, threads = 1;
};

struct Runs {
  Series nanoseconds;  // of processor time, per sample
  Series peak;         // MB beyond what there was before
};

void RunOnce(const std::string& scene, std::uint64_t spp, int crop, Runs& runs) {
  RenderSettings settings;
  settings.spp = spp;
  Job whole = PrepareJob(scene, settings);
  const int x = whole.window.width() / 2, y = whole.window.height() / 2;
  settings.crop = {x, y, x + crop, y + crop};
  const Job job = PrepareJob(scene, settings);
  FilmAccumulator film = MakeFilm(job);
  const double before = double(ResidentBytes());
  if (!ForgetPeak()) throw std::runtime_error("the peak of memory cannot be reset");
  const double start = ProcessCpuSeconds();
  const RunResult result = Run(job.scene, job.plan, RunOptionsOf(job), film);
  const double seconds = ProcessCpuSeconds() - start;
  const std::uint64_t wanted = spp * static_cast<std::uint64_t>(crop * crop);
  if (result.samples != wanted || film.Samples(x, y) != spp) {
    throw std::runtime_error("WRONG: samples are missing");
  }
  runs.nanoseconds.Add(1e9 * seconds / double(wanted));
  runs.peak.Add(1e-6 * (double(PeakResidentBytes()) - before));
}

void Measure(const Flags& flags) {
  const ThreadLimit limit(flags.threads);
  std::vector<Runs> all(flags.spp.size());
  Runs warm;
  RunOnce(flags.scene, flags.spp.front(), flags.crop, warm);
  for (int i = 0; i < flags.repeats; ++i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      RunOnce(flags.scene, flags.spp[k], flags.crop, all[k]);
    }
  }
  std::printf("%s\n", MachineText(ThisMachine()).c_str());
  std::printf("%s, %dx%d pixels, %d threads\n", flags.scene.c_str(), flags.crop,
              flags.crop, MaxThreads());
  std::printf("  %14s %22s %10s %10s\n", "spp", "ns per sample", "of first", "peak MB");
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Series& ns = all[k].nanoseconds;
    std::printf("  %14llu %7.1f [%.1f, %.1f] %+8.2f %% %10.2f\n",
                static_cast<unsigned long long>(flags.spp[k]), ns.Median(), ns.Min(),
                ns.Max(), 100 * (ns.Median() / all[0].nanoseconds.Median() - 1),
                all[k].peak.Max());
  }
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  lanelight::bench::Flags flags;
  CLI::App app("Huge numbers of samples", "bench_samples");
  app.add_option("SCENE", flags.scene);
  app.add_option("--spp", flags.spp)->delimiter(',');
  app.add_option("--crop", flags.crop, "Pixels on a side")->check(CLI::Range(1, 16));
  app.add_option("--repeats", flags.repeats)->check(CLI::Range(1, 1000));
  app.add_option("--threads", flags.threads)->check(CLI::Range(0, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    lanelight::bench::Measure(flags);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
