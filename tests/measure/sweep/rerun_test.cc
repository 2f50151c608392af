// `lanelight sweep` into a directory that has cells already.
#include <catch2/catch.hpp>

#include <chrono>

#include "src/cli/exit_codes.h"
#include "tests/measure/sweep/sweep_folder.h"
#include "tests/measure/sweep/sweep_process.h"

namespace lanelight::sweep_process {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

}  // namespace

TEST_CASE("sweep: finished cells are not rendered again", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  const std::string table = Contents(out + "/sweep.csv");
  CHECK(RenderedBy(Sweep(file, out)) == 0);
  CHECK(Contents(out + "/sweep.csv") == table);

  const std::string lost = out + "/cells/" + DoneCells(out)[3];
  fs::remove(lost + "/report.json");
  CHECK(RenderedBy(Sweep(file, out, {"--table-only"})) == 0);
  CHECK_THAT(Contents(out + "/sweep.csv"), Contains(",missing,"));
  CHECK(RenderedBy(Sweep(file, out, {"--resume"})) == 1);
  fs::remove(lost + "/image.exr");
  CHECK(RenderedBy(Sweep(file, out)) == 1);
  CHECK(TableWithoutTimes(out + "/sweep.csv").find("missing") == std::string::npos);
}

TEST_CASE("sweep: file times do not matter", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  using std::chrono::hours;
  for (const auto shift : {hours(24 * 36500), hours(-24 * 9000)}) {
    for (const auto& entry : fs::recursive_directory_iterator(directory.path())) {
      fs::last_write_time(entry.path(), fs::file_time_type::clock::now() + shift);
    }
    CHECK(RenderedBy(Sweep(file, out)) == 0);
    const std::string cell = out + "/cells/" + DoneCells(out).front();
    fs::remove(cell + "/report.json");
    CHECK(RenderedBy(Sweep(file, out)) == 1);
  }
}

TEST_CASE("sweep: another grid in the same directory", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  Replace(file, "seed = [1, 2]", "seed = [2, 3]");
  const ProcessResult r = Sweep(file, out);
  CHECK(r.exit_code == kExitGood);
  CHECK(RenderedBy(r) == 11);
  CHECK_THAT(r.err, Contains("11 directories") && Contains("seed1"));
  CHECK(CsvRows(out + "/sweep.csv").size() == kSweepCells + 1);
  CHECK_THAT(Contents(out + "/sweep.csv"), !Contains("seed1"));
  CHECK(Contents(out + "/sweep.toml") == Contents(file));
}

TEST_CASE("sweep: cells of other settings are refused", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  const std::string old = Contents(file);
  WriteText(file, old + "[settings]\ncrop = [0, 0, 8, 8]\n");
  const ProcessResult crop = Sweep(file, out);
  CHECK(crop.exit_code == kExitBadInput);
  CHECK_THAT(crop.err, Contains("crop was not set and is now \"0,0,8,8\"") &&
                           Contains("cells/") && Contains("another --out"));
  WriteText(file, old);
  Replace(directory / "other.pbrt", "0.5 0.4 0.3", "0.5 0.4 0.2");
  const ProcessResult scene = Sweep(file, out);
  CHECK(scene.exit_code == kExitBadInput);
  CHECK_THAT(scene.err, Contains("hash of the scene's files") && Contains("/other_"));
  CHECK_THAT(Sweep(file, out, {"--table-only"}).err,
             Contains("rendered with other settings"));
  WriteText(out + "/cells/" + DoneCells(out).back() + "/report.json", "{\"half\": ");
  Replace(directory / "other.pbrt", "0.5 0.4 0.2", "0.5 0.4 0.3");
  CHECK_THAT(Sweep(file, out).err, Contains("is not a report of a sweep"));
}

}  // namespace lanelight::sweep_process
