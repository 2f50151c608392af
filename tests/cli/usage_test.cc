// Flags, help, exit codes and standard streams of the program.
#include <catch2/catch.hpp>

#include "kernels/simd/target.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {

using Catch::Contains;
using Catch::Matches;

TEST_CASE("help and version go to standard output and succeed", "[cli]") {
  const ProcessResult version = RunLanelight({"--version"});
  CHECK(version.exit_code == kExitGood);
  CHECK_THAT(version.out, Matches("lanelight [0-9]+\\.[0-9]+\\.[0-9]+ "
                                  "\\(([0-9a-f]{10,40}(-dirty)?|unknown), "
                                  "(clang|gcc) [0-9]+\\.[0-9]+\\.[0-9]+\\)\n"));
  const ProcessResult help = RunLanelight({"--help"});
  CHECK(help.exit_code == kExitGood);
  CHECK_THAT(help.out, Contains("Examples:") && Contains("Exit codes:"));
  for (const char* command : {"render", "plan", "profile", "info", "compare"}) {
    CHECK_THAT(help.out, Contains(command));
    const ProcessResult detail = RunLanelight({command, "--help"});
    CHECK(detail.exit_code == kExitGood);
    CHECK_THAT(detail.out, Contains("Example"));
    CHECK(detail.err.empty());
  }
}

TEST_CASE("wrong flags exit with 2 and a message", "[cli]") {
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const Case cases[] = {
      {{}, "Usage"},
      {{"rendr", "x.pbrt"}, "did you mean 'render'?"},
      {{"frobnicate"},
       "commands are render, plan, live, profile, bench, info, strategies"},
      {{"render"}, "required"},
      {{"render", "x.pbrt"}, "--output is required"},
      {{"render", "x.pbrt", "-o", "x.png"}, "does not end in .exr"},
      {{"render", "x.pbrt", "-o", "x.exr", "--resoluton", "3x3"},
       "Did you mean --resolution?"},
      {{"render", "x.pbrt", "-o", "x.exr", "--resolution", "3x"}, "WIDTHxHEIGHT"},
      {{"render", "x.pbrt", "-o", "x.exr", "--resolution", "0x3"}, "WIDTHxHEIGHT"},
      {{"render", "x.pbrt", "-o", "x.exr", "--resolution", "99999999999x3"},
       "WIDTHxHEIGHT"},
      {{"render", "x.pbrt", "-o", "x.exr", "--crop", "4,4,2,8"}, "x0 < x1"},
      {{"render", "x.pbrt", "-o", "x.exr", "--spp", "0"}, "--spp"},
      {{"render", "x.pbrt", "-o", "x.exr", "--spp", "-4"}, "--spp"},
      {{"render", "x.pbrt", "-o", "x.exr", "--spp", "1099511627777"}, "--spp"},
      {{"render", "x.pbrt", "-o", "x.exr", "--spp", "4", "--time", "2"}, "excludes"},
      {{"render", "x.pbrt", "-o", "x.exr", "--time", "nan"}, "--time"},
      {{"render", "x.pbrt", "-o", "x.exr", "--target-relmse", "0"}, "--target-relmse"},
      {{"render", "x.pbrt", "-o", "x.exr", "--target-relmse", "nan"}, "--target-relmse"},
      {{"render", "x.pbrt", "-o", "x.exr", "--target-rmse", "-1"}, "--target-rmse"},
      {{"render", "x.pbrt", "-o", "x.exr", "--target-rmse", "low"}, "--target-rmse"},
      {{"render", "x.pbrt", "-o", "x.exr", "--max-depth", "-1"}, "--max-depth"},
      {{"render", "x.pbrt", "-o", "x.exr", "--seed", "-1"}, "not an integer from 0 to"},
      {{"render", "x.pbrt", "-o", "x.exr", "--seed", "18446744073709551616"},
       "from 0 to 18446744073709551615"},
      {{"render", "x.pbrt", "-o", "x.exr", "--seed", "1.5"},
       "--seed: 1.5 is not an integer"},
      {{"profile", "x.pbrt", "--seed", "-1"}, "--seed"},
      {{"profile", "x.pbrt", "--trace-events", "0"}, "--trace-events"},
      {{"profile", "x.pbrt", "--trace-events", "many"}, "--trace-events"},
      {{"profile", "x.pbrt", "--trace", "-"}, "--trace"},
      {{"profile", "x.pbrt", "--strategy", "points=none"}, "--strategy"},
      {{"profile"}, "required"},
      {{"study", "x.pbrt", "--out", "x", "--seed", "-1"}, "--seed"},
      {{"render", "x.pbrt", "-o", "x.exr", "--threads", "-1"}, "--threads"},
      {{"render", "x.pbrt", "-o", "x.exr", "--build", "slow"},
       "\"slow\" is not one of \"fast\", \"high\""},
      {{"render", "x.pbrt", "-o", "x.exr", "--simd", "AVX9000"},
       AvailableTargets().back()},
      {{"render", "x.pbrt", "-o", "x.exr", "--strategy", "points=sobl"},
       "did you mean \"sobol\"?"},
      {{"plan", "x.pbrt", "--strategy", "roulette=constant:2"}, "0.001 to 0.999"},
      {{"render", "x.pbrt", "-o", "x.exr", "--sampler", "zalton"},
       "\"independent\", \"stratified\""},
      {{"render", "x.pbrt", "-o", "x.exr", "--sampler", "zalton"},
       "did you mean \"halton\"?"},
      {{"study", "x.pbrt", "--out", "x", "--strategies", "points=sobl"},
       "--strategies: strategy"},
      {{"stress", "no-such-case"}, "CASE: unknown case or group"},
      {{"render", "x.pbrt", "-o", "x.exr", "--every", "soon"},
       "--every: \"soon\" is not a time of 0.01 to 1000000 seconds"},
      {{"render", "x.pbrt", "--checkpoint", "x", "--part", "3/2"}, "3/2\" is not I/N"},
      {{"render", "x.pbrt", "-o", "x.exr", "--scattering", "cosine"}, "insphere"},
      {{"render", "x.pbrt", "-o", "x.exr", "--depth", "double"}, "half"},
      {{"render", "x.pbrt", "-o", "x.exr", "--png", "x.jpg"}, "does not end in .png"},
      {{"compare", "a.exr"}, "required"},
      {{"compare", "a.exr", "b.exr", "--max-relmse", "-1"}, "--max-relmse"},
  };
  for (const Case& c : cases) {
    const ProcessResult r = RunLanelight(c.arguments);
    INFO(c.message);
    CHECK(r.exit_code == kExitUsage);
    CHECK_THAT(r.err, Contains(c.message));
    CHECK(r.out.empty());
  }
}

TEST_CASE("a SIMD target that is not built is refused with a remedy", "[cli]") {
  const std::vector<std::string> available = AvailableTargets();
  for (const std::string name : {"AVX3", "AVX2", "SSE4"}) {
    if (std::find(available.begin(), available.end(), name) != available.end()) continue;
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"render", "x.pbrt", "-o", "x.exr", "--simd", name},
          {"bench", "--simd", name},
          {"stress", "--simd", name}}) {
      const ProcessResult r = RunLanelight(command);
      INFO(r.err);
      CHECK(r.exit_code == kExitUsage);
      CHECK_THAT(r.err, Contains("`./run build` adds the others") ||
                            Contains("processor cannot run " + name));
    }
  }
}

TEST_CASE("info prints the target, threads and libraries", "[cli]") {
  const ProcessResult r = RunLanelight({"info", "--threads", "1"});
  CHECK(r.exit_code == kExitGood);
  const std::string worst = AvailableTargets().back();
  for (const std::string& word :
       std::vector<std::string>{"machine", "target", "lanes", worst, "threads", "highway",
                                "onetbb", "openexr", "fmt", "nlohmann_json", "cli11"}) {
    CHECK_THAT(r.out, Contains(word));
  }
  // The same commit as --version has.
  const std::string version = RunLanelight({"--version"}).out;
  const std::size_t open = version.find('('), comma = version.find(',');
  const std::string commit = version.substr(open + 1, comma - open - 1);
  CHECK_THAT(r.out, Contains("commit         " + commit + "\n"));
  const ProcessResult forced = RunLanelight({"info", "--simd", worst});
  CHECK_THAT(forced.out, Contains("target         " + worst));
}

TEST_CASE("a closed pipe is not an error", "[cli]") {
  ProcessOptions closed;
  closed.close_stdout_reader = true;
  const ProcessResult r = RunLanelight({"info"}, closed);
  CHECK(r.signal == 0);
  CHECK(r.exit_code == kExitGood);
  CHECK(r.err.empty());
}

TEST_CASE("a full disk behind standard output is an error", "[cli]") {
  ProcessOptions full;
  full.stdout_path = "/dev/full";
  for (const char* argument : {"info", "--help", "--version"}) {
    const ProcessResult r = RunLanelight({argument}, full);
    CHECK(r.exit_code == kExitBadInput);
    CHECK_THAT(r.err, Contains("No space left on device"));
  }
}

TEST_CASE("bad input exits with 1 and names the file", "[cli]") {
  TempDirectory directory;
  const std::string out = directory / "out.exr";
  const ProcessResult missing =
      RunLanelight({"render", directory / "no.pbrt", "-o", out});
  CHECK(missing.exit_code == kExitBadInput);
  CHECK_THAT(missing.err, Contains("no.pbrt"));
  const std::string broken =
      WriteText(directory / "broken.pbrt", "WorldBegin\nShpe \"disk\"\n");
  const ProcessResult parse = RunLanelight({"render", broken, "-o", out});
  CHECK(parse.exit_code == kExitBadInput);
  CHECK_THAT(parse.err, Contains("broken.pbrt:2:") && Contains("Shape"));
  CHECK(RunLanelight({"plan", broken}).exit_code == kExitBadInput);
  const ProcessResult compare = RunLanelight({"compare", out, out});
  CHECK(compare.exit_code == kExitBadInput);
  CHECK_THAT(compare.err, Contains("out.exr"));
  CHECK(directory.Files() == std::vector<std::string>{"broken.pbrt"});
}

}  // namespace lanelight
