// `lanelight sweep` in several processes, and one that is stopped.
#include <catch2/catch.hpp>
#include <signal.h>
#include <unistd.h>

#include <future>

#include "src/cli/exit_codes.h"
#include "tests/measure/sweep/sweep_folder.h"
#include "tests/measure/sweep/sweep_process.h"

namespace lanelight::sweep_process {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

}  // namespace

TEST_CASE("sweep: parts are disjoint and cover the grid", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory);
  REQUIRE(Sweep(file, directory / "whole").exit_code == kExitGood);
  std::size_t before = 0;
  for (const char* part : {"3/3", "1/3", "2/3"}) {
    const ProcessResult r = Sweep(file, directory / "out", {"--part", part});
    CHECK(r.exit_code == kExitGood);
    const std::size_t now = DoneCells(directory / "out").size();
    CHECK(RenderedBy(r) == int(now - before));
    CHECK(now - before == (part[0] == '1' ? 8u : 7u));
    before = now;
  }
  CHECK(SamePixels(CellPixels(directory / "out"), CellPixels(directory / "whole")));
  CHECK(TableWithoutTimes(directory / "out/sweep.csv") ==
        TableWithoutTimes(directory / "whole/sweep.csv"));
  for (const char* wrong :
       {"0/3", "4/3", "1", "1/", "/2", "a/b", "1/0", "1/2/3", "-1/2"}) {
    const ProcessResult r = Sweep(file, directory / "out", {"--part", wrong});
    CHECK(r.exit_code == kExitUsage);
    CHECK_THAT(r.err, Contains("is not I/N"));
  }
}

TEST_CASE("sweep: several processes render each cell once", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  Replace(file, "spp = [4, 64]", "spp = [256, 64]");
  REQUIRE(Sweep(file, directory / "whole").exit_code == kExitGood);
  std::vector<std::future<ProcessResult>> processes;
  for (int i = 0; i < 3; ++i) {
    processes.push_back(
        std::async(std::launch::async, [&] { return Sweep(file, out, {"--wait"}); }));
  }
  int rendered = 0, busy = 0;
  for (auto& process : processes) {
    const ProcessResult r = process.get();
    INFO(r.err);
    CHECK(r.exit_code == kExitGood);
    CHECK_THAT(r.out, Contains("22 of 22 cells are done"));
    rendered += RenderedBy(r);
    busy += RenderedBy(r) > 0;
  }
  CHECK(rendered == kSweepCells);
  CHECK(busy >= 2);
  CHECK(SamePixels(CellPixels(out), CellPixels(directory / "whole")));
  CHECK(TableWithoutTimes(out + "/sweep.csv") ==
        TableWithoutTimes(directory / "whole/sweep.csv"));
}

TEST_CASE("sweep: Ctrl-C aborts the cell and sets the exit code for schedulers",
          "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  Replace(file, "spp = [4, 64]", "spp = [4, 4096]");
  Replace(file, "spp = 64", "spp = 4096");
  for (const int signal : {SIGINT, SIGTERM}) {
    ProcessOptions options;
    options.trigger = "4096spp";
    options.action = [&](int child) {
      usleep(100000);
      kill(child, signal);
    };
    const ProcessResult r = Sweep(file, out, {}, options);
    CHECK(r.exit_code == kExitInterrupted);
    CHECK_THAT(r.err, Contains("discarded"));
    CHECK(DoneCells(out).size() < kSweepCells);
    CHECK(Rubbish(out).empty());
    CHECK(fs::exists(out + "/sweep.csv"));
  }
}

}  // namespace lanelight::sweep_process
