#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "bench/checkpoint/cases.h"
#include "bench/series.h"
#include "src/base/core/clock.h"
#include "src/render/job/merge.h"

namespace lanelight::bench {
namespace {

// Returns the bytes of this process in memory, now ("VmRSS:") or at most ("VmHWM:").
double MemoryOf(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::size_t kib = 0;
    if (word == name && status >> kib) return double(kib << 10);
  }
  return 0;
}

// Measures the peak anew. Returns false where Linux does not allow that.
bool ForgetPeak() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;
  return refs.good();
}

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The states of all parts, from one film: as if each had rendered its own pixels, except
// that each counts the samples of all.
std::vector<std::string> WriteParts(const CheckpointBench& bench, const Job& job,
                                    int count, RunState& state) {
  std::vector<std::string> paths;
  for (int part = 1; part <= count; ++part) {
    CheckpointSettings settings;
    settings.path = bench.Path(fmt::format("part-{}.state", part));
    settings.part = {part, count};
    fs::remove(settings.path);
    Checkpoint checkpoint(job, settings, HeadOf(job), ThrowProblem);
    checkpoint.Save(state);
    checkpoint.Finish();
    paths.push_back(settings.path);
  }
  return paths;
}

struct Merging {
  Series seconds, cpu;
  double file_bytes = 0, peak = 0;  // beyond what there was before
};

Merging Measure(const CheckpointBench& bench, const std::vector<std::string>& paths,
                const Job& job, BenchFilm& whole) {
  Merging m;
  for (const std::string& path : paths) m.file_bytes += double(fs::file_size(path));
  for (int i = 0; i <= bench.repeats; ++i) {
    const double before = MemoryOf("VmRSS:");
    if (!ForgetPeak()) throw std::runtime_error("the peak of memory cannot be reset");
    const Clock::time_point start = Clock::now();
    const double cpu = ProcessCpuSeconds();
    MergedRender merged = MergeStates(paths);
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    const double used_cpu = ProcessCpuSeconds() - cpu;
    if (i == 0) {  // warms up, and is verified
      BenchFilm film(job);
      film.film = std::move(*merged.film);
      if (merged.missing != 0 || !film.SameAs(whole)) {
        throw std::runtime_error("WRONG: the merged film is not the uncut one");
      }
      continue;
    }
    m.seconds.Add(elapsed.count());
    m.cpu.Add(used_cpu);
    m.peak = std::max(m.peak, MemoryOf("VmHWM:") - before);
  }
  return m;
}

}  // namespace

nlohmann::json MeasureMerging(const CheckpointBench& bench) {
  const Job job = JobOf(bench, bench.resolution, bench.spp);
  BenchFilm film(job);
  nlohmann::json out = nlohmann::json::array();
  const double film_bytes = double(film.Bytes());
  std::printf("  film %.1f MB; GB/s of film\n", 1e-6 * film_bytes);
  std::printf("  %5s %9s %8s %8s %8s %8s %8s %12s\n", "parts", "files MB", "seconds",
              "least", "most", "cpu s", "GB/s", "peak / film");
  const auto measure = [&](RunState& state) {
    for (int count : bench.parts) {
      const auto paths = WriteParts(bench, job, count, state);
      const Merging m = Measure(bench, paths, job, film);
      for (const std::string& path : paths) fs::remove(path);
      std::printf("  %5d %9.1f %8.3f %8.3f %8.3f %8.3f %8.2f %12.3f\n", count,
                  1e-6 * m.file_bytes, m.seconds.Median(), m.seconds.Min(),
                  m.seconds.Max(), m.cpu.Median(), 1e-9 * film_bytes / m.seconds.Median(),
                  m.peak / film_bytes);
      std::fflush(stdout);
      out.push_back({{"parts", count},
                     {"film_bytes", film_bytes},
                     {"file_bytes", m.file_bytes},
                     {"seconds", m.seconds.Json()},
                     {"cpu", m.cpu.Json()},
                     {"gb_per_second", 1e-9 * film_bytes / m.seconds.Median()},
                     {"peak_over_film", m.peak / film_bytes}});
    }
  };
  CheckpointSettings none;
  Checkpoint checkpoint(job, none, HeadOf(job), ThrowProblem);
  WatchedCheckpointer checkpointer(checkpoint, measure);
  RunOptions options = RunOptionsOf(job);
  options.tiles = checkpoint.tiles();
  options.checkpointer = &checkpointer;
  Run(job.scene, job.plan, options, film.film);
  return out;
}

}  // namespace lanelight::bench
