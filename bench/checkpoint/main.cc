// Measures the cost of checkpoints: their pause, the speed of a render that writes them,
// merging of parts, and tiles. First verifies that the film of a render in parts is that
// of an undivided one.
//
//   bench_checkpoint [SCENE] [--only pause,slowdown,merging,tiles] [--json FILE]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "bench/checkpoint/cases.h"
#include "kernels/simd/target.h"
#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/render/job/machine_json.h"
#include "src/render/job/report.h"

namespace lanelight::bench {
namespace {

struct Case {
  const char* name;
  nlohmann::json (*measure)(const CheckpointBench&);
};
constexpr Case kCases[] = {{"pause", MeasurePause},
                           {"slowdown", MeasureSlowdown},
                           {"merging", MeasureMerging},
                           {"tiles", MeasureTiles}};

struct Flags {
  CheckpointBench bench;
  std::vector<std::string> only;
  std::string json;
  int threads = 0;
};

void Parse(int argc, char** argv, CLI::App& app, Flags& flags) {
  CheckpointBench& bench = flags.bench;
  bench.scene = "scenes/cornell-box.pbrt";
  app.add_option("SCENE", bench.scene, "Scene in the text format of pbrt-v4");
  app.add_option("--width", bench.resolution[0], "Of the film")
      ->check(CLI::Range(16, 1 << 14));
  app.add_option("--height", bench.resolution[1], "Of the film")
      ->check(CLI::Range(16, 1 << 14));
  app.add_option("--spp", bench.spp, "Samples per pixel of what is kept and merged")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--repeats", bench.repeats, "Repetitions")->check(CLI::Range(1, 1000));
  app.add_option("--parts", bench.parts, "Parts to merge, e.g. 1,4")->delimiter(',');
  app.add_option("--tile-spp", bench.tile_spp, "Samples per pixel of `tiles`")
      ->delimiter(',');
  app.add_option("--only", flags.only, "Some of pause,slowdown,merging,tiles")
      ->delimiter(',')
      ->check(CLI::IsMember({"pause", "slowdown", "merging", "tiles"}));
  app.add_option("--threads", flags.threads, "0: all cores")->check(CLI::Range(0, 1024));
  app.add_option("--folder", bench.folder, "Where the states are written");
  app.add_option("--json", flags.json, "Write the figures here too");
  app.parse(argc, argv);
}

int Main(const Flags& flags) {
  const ThreadLimit limit(flags.threads);
  std::printf("%s\n", MachineText(ThisMachine()).c_str());
  std::printf("%s, %dx%d, %d threads, %s\n", flags.bench.scene.c_str(),
              flags.bench.resolution[0], flags.bench.resolution[1], MaxThreads(),
              SimdTarget().name().c_str());
  VerifyResumeAndMerge(flags.bench);
  std::printf("verified: resumed and merged films have the bits of the uncut one\n");
  nlohmann::json out = {{"schema", 1},
                        {"scene", flags.bench.scene},
                        {"resolution", flags.bench.resolution},
                        {"threads", MaxThreads()},
                        {"target", TargetJson({})},
                        {"machine", ToJson(ThisMachine())}};
  for (const Case& c : kCases) {
    const bool wanted =
        flags.only.empty() ||
        std::find(flags.only.begin(), flags.only.end(), c.name) != flags.only.end();
    if (!wanted) continue;
    std::printf("\n%s\n", c.name);
    out[c.name] = c.measure(flags.bench);
    std::fflush(stdout);
  }
  if (!flags.json.empty()) std::ofstream(flags.json) << out.dump(2) << '\n';
  return 0;
}

}  // namespace
}  // namespace lanelight::bench

int main(int argc, char** argv) {
  CLI::App app("What keeping a render's state costs", "bench_checkpoint");
  lanelight::bench::Flags flags;
  try {
    lanelight::bench::Parse(argc, argv, app, flags);
    return lanelight::bench::Main(flags);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
