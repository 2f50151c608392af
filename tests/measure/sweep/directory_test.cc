// `lanelight sweep` where its directory does not behave.
#include <catch2/catch.hpp>
#include <unistd.h>

#include "src/base/image/atomic_file.h"
#include "src/cli/exit_codes.h"
#include "tests/measure/sweep/sweep_folder.h"
#include "tests/measure/sweep/sweep_process.h"

namespace lanelight::sweep_process {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

}  // namespace

TEST_CASE("sweep: a directory that cannot be written", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out, {"--part", "1/2"}).exit_code == kExitGood);
  const auto before = CellPixels(out);
  using fs::perms;
  const auto read_only = perms::owner_read | perms::owner_exec | perms::group_read |
                         perms::group_exec | perms::others_read | perms::others_exec;
  fs::permissions(directory.path(), read_only);
  fs::permissions(out, read_only);
  fs::permissions(out + "/cells", read_only);
  ProcessOptions options;
  // The superuser may write anywhere.
  if (geteuid() == 0) options.prepare = [] { [[maybe_unused]] int r = setuid(65534); };
  const ProcessResult r = Sweep(file, out, {}, options);
  INFO(r.err);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("cannot write '" + out) && Contains("Permission denied"));
  CHECK(SamePixels(CellPixels(out), before));
  fs::permissions(directory.path(), perms::owner_all);
  fs::permissions(out, perms::owner_all);
  fs::permissions(out + "/cells", perms::owner_all);
  CHECK(RenderedBy(Sweep(file, out)) == kSweepCells / 2);
}

TEST_CASE("sweep: files left by killed processes are removed", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out, {"--part", "1/11"}).exit_code == kExitGood);
  // Left by a process that was killed while it checked that it can write.
  WriteFileAtomically(out + "/cells/.probe.4711.0.tmp", "");
  WriteFileAtomically(out + "/cells/.probed", "the user's");
  CHECK_FALSE(Rubbish(out).empty());
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  CHECK(Rubbish(out).empty());
  CHECK(fs::exists(out + "/cells/.probed"));
}

TEST_CASE("sweep: a directory that vanishes ends the sweep", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  ProcessOptions options;
  options.temp_directory = directory.path();
  options.trigger = "sweep: 4 of 22";
  options.action = [&](int) { fs::rename(out, directory / "away"); };
  const ProcessResult r = Sweep(file, out, {}, options);
  INFO(r.err);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("no directory '" + out + "/cells'"));
  CHECK_FALSE(fs::exists(out));  // not made anew
  // What there was is whole, and goes on elsewhere.
  const int done = static_cast<int>(DoneCells(directory / "away").size());
  CHECK(done >= 3);
  CHECK(RenderedBy(Sweep(file, directory / "away")) == kSweepCells - done);
  CHECK(Rubbish(directory / "away").empty());
}

TEST_CASE("sweep: a file system without locks needs parts", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  ProcessOptions options;
  options.prepare = ForbidLocks;
  const ProcessResult r = Sweep(file, out, {}, options);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("does not support locks") && Contains("--part I/N"));
  CHECK(RenderedBy(Sweep(file, out, {"--part", "1/2"}, options)) == 11);
  CHECK(RenderedBy(Sweep(file, out, {"--part", "2/2"}, options)) == 11);
}

TEST_CASE("sweep: a foreign report file is refused with its name", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out, {"--part", "1/22"}).exit_code == kExitGood);
  REQUIRE(DoneCells(out).size() == 1);
  const std::string report = out + "/cells/" + DoneCells(out)[0] + "/report.json";
  const std::string deep(1000000, '['), end(1000000, ']');
  for (const std::string& text :
       {std::string("[]"), std::string("{\"sweep\": 1"),
        "{\"sweep\": {\"settings\": {}, \"values\": {\"seed\": " + deep + end + "}}}"}) {
    WriteText(report, text);
    const ProcessResult r = Sweep(file, out);
    CHECK(r.exit_code == kExitBadInput);
    CHECK_THAT(r.err,
               Contains(report) && Contains("remove it") && !Contains("exception"));
  }
}

}  // namespace lanelight::sweep_process
