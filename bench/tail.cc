// The tail of a render: how long threads have nothing to do while the last tasks run, and
// how many rays per second of the render that costs.
//
//   bench_tail SCENE... [--width N --height N] [--spp N] [--repeats N] [--json FILE]
//
// With the threads of this machine it is measured from traces, in wall time. For more
// threads the processor time of each tile is measured, one by one, and they are dealt to
// threads as they come: the next tile to whoever is free. Tiles of --tile pixels; --json
// writes their costs, which bench/simulate_cluster.py takes.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <queue>
#include <stdexcept>

#include "bench/series.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/render/job/job.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/machine_json.h"
#include "src/render/wave/tiles.h"

namespace lanelight::bench {
namespace {

struct Flags {
  std::vector<std::string> scenes;
  std::array<int, 2> resolution = {960, 540};
  std::uint64_t spp = 16;
  int repeats = 5, tile = 16;
  std::string json;
};

Job JobOf(const std::string& scene, const Flags& flags) {
  RenderSettings settings;
  settings.spp = flags.spp;
  settings.resolution = flags.resolution;
  return PrepareJob(scene, settings);
}

struct Tail {
  double alone = 0;  // seconds in which not all threads work
  double lost = 0;   // of all threads' time
};

// From the end of the first thread to that of the last one.
Tail TailOf(const RunTrace& trace, int threads) {
  std::vector<double> ends;
  for (const ThreadTrace& t : trace.threads) {
    if (t.dropped > 0) throw std::runtime_error("the trace is full: fewer --spp");
    if (t.events.empty()) continue;
    ends.push_back(double(t.events.back().end - trace.start) * trace.seconds_per_tick);
  }
  // A thread that never came to work idles all the time.
  ends.resize(static_cast<std::size_t>(threads), 0.0);
  const double last = *std::max_element(ends.begin(), ends.end());
  Tail tail;
  tail.alone = last - *std::min_element(ends.begin(), ends.end());
  for (double end : ends) tail.lost += last - end;
  tail.lost /= last * threads;
  return tail;
}

void MeasureThreads(const Job& job, const Flags& flags, int threads,
                    nlohmann::json& out) {
  const ThreadLimit limit(threads);
  Series alone, lost, rays;
  for (int i = 0; i <= flags.repeats; ++i) {
    FilmAccumulator film = MakeFilm(job);
    RunOptions options = RunOptionsOf(job);
    options.profiling.trace_events = 1 << 21;
    const RunResult result = Run(job.scene, job.plan, options, film);
    if (i == 0) continue;  // warmed up
    const Tail tail = TailOf(result.trace, threads);
    alone.Add(tail.alone);
    lost.Add(tail.lost);
    rays.Add(double(result.rays_closest + result.rays_shadow) / result.seconds);
  }
  std::printf(
      "  %4d threads, traced: last tasks %6.1f ms [%.1f, %.1f], lost %.2f %% "
      "[%.2f, %.2f], %.0f of %.0f krays/s\n",
      threads, 1e3 * alone.Median(), 1e3 * alone.Min(), 1e3 * alone.Max(),
      100 * lost.Median(), 100 * lost.Min(), 100 * lost.Max(),
      1e-3 * lost.Median() * rays.Median(), 1e-3 * rays.Median());
  out["traced"].push_back({{"threads", threads},
                           {"alone_seconds", alone.Json()},
                           {"lost", lost.Json()},
                           {"rays_per_second", rays.Json()}});
}

// Processor seconds of each tile by itself.
std::vector<double> TileCosts(const Job& job, const std::vector<PixelRect>& tiles) {
  const ThreadLimit limit(1);
  RunOptions options = RunOptionsOf(job);
  std::vector<double> costs;
  for (const PixelRect& tile : tiles) {
    options.tiles = {tile};
    FilmAccumulator own = MakeFilm(job);
    const RunResult result = Run(job.scene, job.plan, options, own);
    double seconds = 0;
    for (const StageProfile& stage : result.stages) seconds += stage.seconds;
    for (const StageProfile& part : result.parts) seconds += part.seconds;
    costs.push_back(seconds);
  }
  return costs;
}

// The next tile to whoever is free first.
Tail Deal(const std::vector<double>& costs, int threads) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free;
  for (int i = 0; i < threads; ++i) free.push(0);
  double work = 0, last = 0;
  for (double cost : costs) {
    const double end = free.top() + cost;
    free.pop();
    free.push(end);
    work += cost;
    last = std::max(last, end);
  }
  return {last - free.top(), 1 - work / (last * threads)};
}

void SimulateThreads(const std::vector<double>& costs, double rays, nlohmann::json& out) {
  double work = 0, squares = 0;
  for (double c : costs) {
    work += c;
    squares += c * c;
  }
  const double n = double(costs.size()), mean = work / n;
  const double deviation = std::sqrt(std::max(0.0, squares / n - mean * mean));
  std::printf("  %zu tiles of %.2f ms, deviation %.0f %%, most %.2f ms\n", costs.size(),
              1e3 * mean, 100 * deviation / mean,
              1e3 * *std::max_element(costs.begin(), costs.end()));
  for (int threads : {2, 4, 8, 16, 32, 64, 128, 256}) {
    const Tail tail = Deal(costs, threads);
    const double speed = rays / work * threads;  // without a tail
    std::printf(
        "  %4d threads, dealt:  last tasks %6.1f ms, lost %.2f %%, %.0f of %.0f "
        "krays/s\n",
        threads, 1e3 * tail.alone, 100 * tail.lost, 1e-3 * tail.lost * speed,
        1e-3 * speed);
    out["dealt"].push_back({{"threads", threads},
                            {"alone_seconds", tail.alone},
                            {"lost", tail.lost},
                            {"rays_per_second", (1 - tail.lost) * speed}});
  }
}

nlohmann::json Measure(const std::string& scene, const Flags& flags) {
  const Job job = JobOf(scene, flags);
  std::printf("%s, %dx%d, %llu samples per pixel; load %.2f s, build %.2f s\n",
              scene.c_str(), flags.resolution[0], flags.resolution[1],
              static_cast<unsigned long long>(flags.spp), job.loaded->load_seconds,
              job.loaded->build_seconds);
  nlohmann::json out = {
      {"scene", scene},
      {"machine", ToJson(ThisMachine())},
      {"resolution", flags.resolution},
      {"spp", flags.spp},
      {"tile", flags.tile},
      {"start_seconds", job.loaded->load_seconds + job.loaded->build_seconds}};
  for (int threads : {1, 2}) MeasureThreads(job, flags, threads, out);
  const RunResult whole = RunJob(job).result;
  const std::vector<double> costs = TileCosts(job, TilesOf(job.window, flags.tile));
  SimulateThreads(costs, double(whole.rays_closest + whole.rays_shadow), out);
  for (double cost : costs) {
    out["tile_microseconds"].push_back(static_cast<int>(1e6 * cost + 0.5));
  }
  return out;
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  using namespace lanelight::bench;
  Flags flags;
  CLI::App app("What the tail of a render costs", "bench_tail");
  app.add_option("SCENE", flags.scenes)->required();
  app.add_option("--width", flags.resolution[0])->check(CLI::Range(16, 1 << 14));
  app.add_option("--height", flags.resolution[1])->check(CLI::Range(16, 1 << 14));
  app.add_option("--spp", flags.spp)->check(CLI::Range(1, 1 << 20));
  app.add_option("--repeats", flags.repeats)->check(CLI::Range(1, 1000));
  app.add_option("--tile", flags.tile)->check(CLI::Range(4, 1024));
  app.add_option("--json", flags.json, "Write the figures here too");
  CLI11_PARSE(app, argc, argv);
  try {
    using namespace lanelight;
    std::printf("%s\n", MachineText(ThisMachine()).c_str());
    nlohmann::json out = nlohmann::json::array();
    for (const std::string& scene : flags.scenes) out.push_back(Measure(scene, flags));
    if (!flags.json.empty()) std::ofstream(flags.json) << out.dump() << '\n';
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
