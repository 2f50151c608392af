// Sweeps that are killed at any moment, and go on.
#include <catch2/catch.hpp>
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "src/cli/exit_codes.h"
#include "tests/measure/sweep/sweep_folder.h"

namespace lanelight {
namespace {

// Kills a sweep `kills` times at moments between start and end, and compares the result
// with an undisturbed sweep.
void KillAndResume(int kills, std::uint32_t seed) {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory);
  const auto arguments = [&](const char* out) {
    return std::vector<std::string>{"sweep", file, "--out", directory / out};
  };
  const ProcessResult whole = RunLanelight(arguments("whole"));
  REQUIRE(whole.exit_code == kExitGood);
  const auto expected = CellPixels(directory / "whole");
  REQUIRE(expected.size() == kSweepCells);

  std::mt19937 random(seed);
  int killed = 0;
  for (int i = 0; i < kills; ++i) {
    const double fraction = std::uniform_real_distribution<double>(0, 0.6)(random);
    ProcessOptions options;
    options.trigger = "";
    options.action = [&](int child) {
      std::this_thread::sleep_for(
          std::chrono::duration<double>(fraction * whole.seconds));
      kill(child, SIGKILL);
    };
    const ProcessResult r = RunLanelight(arguments("out"), options);
    killed += r.signal == SIGKILL;
    // Whatever counts as done is done.
    for (const auto& [name, pixels] : CellPixels(directory / "out")) {
      CHECK(pixels == expected.at(name));
    }
    // Once it is whole, from the beginning.
    if (DoneCells(directory / "out").size() == kSweepCells) {
      std::filesystem::remove_all(directory / "out");
    }
  }
  CHECK(killed >= kills / 2);
  const ProcessResult last = RunLanelight(arguments("out"));
  INFO(last.err);
  CHECK(last.exit_code == kExitGood);
  CHECK(SamePixels(CellPixels(directory / "out"), expected));
  for (const std::string& path : Rubbish(directory / "out")) {
    // Of a table or page that was being written: harmless, and beside the cells.
    CHECK(std::filesystem::path(path).parent_path() == directory / "out");
  }
}

}  // namespace

TEST_CASE("sweep: killed five times, images are bit-identical", "[sweep][cli]") {
  KillAndResume(5, 1);
}

TEST_CASE("sweep: killed twenty-five times, images are bit-identical",
          "[sweep][cli][slow]") {
  KillAndResume(25, 2);
}

}  // namespace lanelight
