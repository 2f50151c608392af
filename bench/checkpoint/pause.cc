#include <chrono>
#include <cstdio>
#include <filesystem>

#include "bench/checkpoint/cases.h"
#include "bench/series.h"
#include "src/base/core/clock.h"
#include "src/base/core/parallel.h"
#include "src/render/job/identity.h"

namespace lanelight::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// One checkpoint, and nothing else at the same time.
struct Steps {
  Series pause, pause_cpu;  // the render stands still
  Series write, write_cpu;  // beside the render

  void Time(Checkpoint& checkpoint, RunState& state) {
    const Clock::time_point start = Clock::now();
    const double cpu = ProcessCpuSeconds();
    checkpoint.Save(state);
    const double paused = Since(start), paused_cpu = ProcessCpuSeconds() - cpu;
    checkpoint.Finish();
    pause.Add(paused);
    pause_cpu.Add(paused_cpu);
    write.Add(Since(start) - paused);
    write_cpu.Add(ProcessCpuSeconds() - cpu - paused_cpu);
  }
};

void Print(const char* what, const Series& s) {
  std::printf("  %-34s %8.3f  [%.3f, %.3f]\n", what, s.Median(), s.Min(), s.Max());
}

CheckpointSettings SettingsOf(const CheckpointBench& bench, double seconds) {
  CheckpointSettings settings;
  settings.path = bench.Path("pause.state");
  settings.seconds = seconds;
  fs::remove(settings.path);
  return settings;
}

// The cost of one render: processor seconds and wall seconds.
struct Speed {
  double cpu = 0, wall = 0, pause = 0;
  int checkpoints = 0;
};

Speed RenderWith(const Job& job, const CheckpointBench& bench, double seconds) {
  BenchFilm film(job);
  Checkpoint checkpoint(job, SettingsOf(bench, seconds), HeadOf(job), ThrowProblem);
  RunOptions options = RunOptionsOf(job);
  options.tiles = checkpoint.tiles();
  if (seconds > 0) options.checkpointer = &checkpoint;
  const Clock::time_point start = Clock::now();
  const double cpu = ProcessCpuSeconds();
  Run(job.scene, job.plan, options, film.film);
  checkpoint.Finish();
  Speed speed = {ProcessCpuSeconds() - cpu, Since(start), checkpoint.pause_seconds(),
                 checkpoint.count()};
  fs::remove(bench.Path("pause.state"));
  return speed;
}

}  // namespace

nlohmann::json MeasurePause(const CheckpointBench& bench) {
  const Job job = JobOf(bench, bench.resolution, bench.spp);
  BenchFilm film(job);
  const CheckpointSettings settings = SettingsOf(bench, 1e9);
  Checkpoint checkpoint(job, settings, HeadOf(job), ThrowProblem);
  Steps steps;
  WatchedCheckpointer checkpointer(checkpoint, [&](RunState& state) {
    checkpoint.Save(state);  // warms up
    checkpoint.Finish();
    for (int i = 0; i < bench.repeats; ++i) steps.Time(checkpoint, state);
  });
  RunOptions options = RunOptionsOf(job);
  options.tiles = checkpoint.tiles();
  options.checkpointer = &checkpointer;
  Run(job.scene, job.plan, options, film.film);
  const double film_bytes = double(film.Bytes()),
               file_bytes = double(fs::file_size(settings.path));
  fs::remove(settings.path);
  // The fraction of a minute of all threads, on an otherwise idle machine.
  const double threads = MaxThreads();
  const double cost = steps.pause.Median() + steps.write_cpu.Median() / threads;
  const double minimum = (steps.pause_cpu.Median() + steps.write_cpu.Median()) / threads;
  std::printf("  film %.1f MB, file %.1f MB\n", 1e-6 * film_bytes, 1e-6 * file_bytes);
  Print("pause, s", steps.pause);
  Print("processor time of it, s", steps.pause_cpu);
  Print("writing beside the render, s", steps.write);
  Print("processor time of it, s", steps.write_cpu);
  std::printf("  of a minute: %.2f %%; by processor time alone %.2f %%\n", cost / 0.6,
              minimum / 0.6);
  return {{"film_bytes", film_bytes},     {"file_bytes", file_bytes},
          {"pause", steps.pause.Json()},  {"pause_cpu", steps.pause_cpu.Json()},
          {"write", steps.write.Json()},  {"write_cpu", steps.write_cpu.Json()},
          {"share_of_minute", cost / 60}, {"share_of_minute_cpu", minimum / 60}};
}

nlohmann::json MeasureSlowdown(const CheckpointBench& bench) {
  const Job job = JobOf(bench, bench.resolution, bench.spp);
  constexpr double kEvery[] = {0, 1, 60};  // seconds; 0: no state at all
  RenderWith(job, bench, 0);
  Series cpu[3], wall[3], ratio[3], count, pause;
  for (int i = 0; i < bench.repeats; ++i) {
    Speed now[3];
    for (int k = 0; k < 3; ++k) {  // in turns, none always the first
      const int way = (i + k) % 3;
      now[way] = RenderWith(job, bench, kEvery[way]);
    }
    for (int way = 0; way < 3; ++way) {
      cpu[way].Add(now[way].cpu);
      wall[way].Add(now[way].wall);
      ratio[way].Add(now[way].cpu / now[0].cpu - 1);
    }
    count.Add(now[1].checkpoints);
    pause.Add(now[1].pause / now[1].checkpoints);
  }
  nlohmann::json out = nlohmann::json::array();
  for (int way = 0; way < 3; ++way) {
    std::printf(
        "  every %2.0f s: processor %.2f s, wall %.2f s, against none %+.2f %% "
        "[%+.2f, %+.2f] of processor time\n",
        kEvery[way], cpu[way].Median(), wall[way].Median(), 100 * ratio[way].Median(),
        100 * ratio[way].Min(), 100 * ratio[way].Max());
    out.push_back({{"every_seconds", kEvery[way]},
                   {"cpu", cpu[way].Json()},
                   {"wall", wall[way].Json()},
                   {"slower", ratio[way].Json()}});
  }
  std::printf("  every 1 s: %.0f states, %.3f s pause each (60: one, the last)\n",
              count.Median(), pause.Median());
  return out;
}

}  // namespace lanelight::bench
