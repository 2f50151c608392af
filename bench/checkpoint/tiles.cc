#include <cstdio>

#include "bench/checkpoint/cases.h"
#include "bench/series.h"
#include "src/base/core/clock.h"
#include "src/render/job/parts.h"

namespace lanelight::bench {
namespace {

double CpuSeconds(const Job& job, const std::vector<PixelRect>& tiles) {
  BenchFilm film(job);
  RunOptions options = RunOptionsOf(job);
  options.tiles = tiles;
  const double start = ProcessCpuSeconds();
  Run(job.scene, job.plan, options, film.film);
  return ProcessCpuSeconds() - start;
}

}  // namespace

nlohmann::json MeasureTiles(const CheckpointBench& bench) {
  nlohmann::json out = nlohmann::json::array();
  std::printf("  %5s %14s %14s %20s\n", "spp", "ordinary, s", "checkpoint's, s",
              "slower by");
  for (std::uint64_t spp : bench.tile_spp) {
    const Job job = JobOf(bench, bench.tile_resolution, spp);
    CheckpointSettings settings;
    const Checkpoint checkpoint(job, settings, HeadOf(job), ThrowProblem);
    Series ordinary, kept, ratio;
    CpuSeconds(job, {});
    // Short ones more often.
    const int repeats = bench.repeats * static_cast<int>(spp < 16 ? 4 : 1);
    for (int i = 0; i < repeats; ++i) {
      double now[2];
      for (int k = 0; k < 2; ++k) {
        const bool own = (i + k) % 2 == 1;
        now[own] = CpuSeconds(job, own ? checkpoint.tiles() : std::vector<PixelRect>());
      }
      ordinary.Add(now[0]);
      kept.Add(now[1]);
      ratio.Add(now[1] / now[0] - 1);
    }
    std::printf("  %5llu %14.3f %14.3f %+8.2f %% [%+.2f, %+.2f]\n",
                static_cast<unsigned long long>(spp), ordinary.Median(), kept.Median(),
                100 * ratio.Median(), 100 * ratio.Min(), 100 * ratio.Max());
    std::fflush(stdout);
    out.push_back({{"spp", spp},
                   {"ordinary_cpu", ordinary.Json()},
                   {"checkpoint_cpu", kept.Json()},
                   {"slower", ratio.Json()}});
  }
  return out;
}

}  // namespace lanelight::bench
