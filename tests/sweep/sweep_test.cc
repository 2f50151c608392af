// `lanelight sweep` from the outside: what it renders, and what it keeps.
#include <catch2/catch.hpp>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fcntl.h>
#include <fstream>
#include <future>
#include <set>
#include <sstream>

#include "src/cli/exit_codes.h"
#include "tests/sweep/sweep_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;
using Json = nlohmann::json;

ProcessResult Sweep(const std::string& file, const std::string& out,
                    std::vector<std::string> more = {},
                    const ProcessOptions& options = {}) {
  std::vector<std::string> arguments = {"sweep", file, "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunLanelight(arguments, options);
}

// "22 of 22 cells are done, 5 of them by this process".
int RenderedBy(const ProcessResult& r) {
  const std::size_t at = r.out.find("are done, ");
  return at == std::string::npos ? -1 : std::atoi(r.out.c_str() + at + 10);
}

std::string Contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void Replace(const std::string& path, const std::string& from, const std::string& to) {
  std::string text = Contents(path);
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  WriteText(path, text.replace(at, from.size(), to));
}

std::vector<std::vector<std::string>> CsvRows(const std::string& path) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (const char c : Contents(path)) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

// The table without what clocks say.
std::string TableWithoutTimes(const std::string& path) {
  const auto rows = CsvRows(path);
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string& name = rows[0].at(i);
      const bool time = (name.find("_second") != std::string::npos && name[0] != 't') ||
                        name == "wavefront_bytes";  // of the threads that took part
      text += (time ? "" : row[i]) + ",";
    }
    text += "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("sweep: a cell is the render of its settings", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  const ProcessResult r = Sweep(file, out, {"--threads"});
  CHECK(r.exit_code == kExitUsage);
  const ProcessResult all = Sweep(file, out);
  INFO(all.err);
  REQUIRE(all.exit_code == kExitGood);
  CHECK_THAT(all.out, Contains("22 of 22 cells are done, 22 of them by this process"));
  CHECK(DoneCells(out).size() == kSweepCells);
  CHECK(Rubbish(out).empty());
  CHECK(Contents(out + "/sweep.toml") == Contents(file));

  // One whose scene was compiled for another strategy and seed.
  const auto pixels = CellPixels(out);
  const auto cell = std::find_if(pixels.begin(), pixels.end(), [](const auto& entry) {
    return entry.first.find("other_48x36_points=independent_64spp_seed2-") == 0;
  });
  REQUIRE(cell != pixels.end());
  const ProcessResult render = RunLanelight(
      {"render", directory / "other.pbrt", "-o", directory / "one.exr", "--resolution",
       "48x36", "--spp", "64", "--seed", "2", "--strategy",
       ReadJson(out + "/cells/" + cell->first + "/report.json")["settings"]["strategy"]});
  INFO(render.err);
  REQUIRE(render.exit_code == kExitGood);
  const Image one = ReadExr(directory / "one.exr");
  CHECK(std::equal(one.pixels.begin(), one.pixels.end(), cell->second.begin(),
                   cell->second.end()));
  // And cells differ.
  std::set<std::vector<float>> different;
  for (const auto& [name, values] : pixels) different.insert(values);
  CHECK(different.size() == kSweepCells - 10);  // the two scenes are the same
}

TEST_CASE("sweep: the table", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  const auto rows = CsvRows(out + "/sweep.csv");
  REQUIRE(rows.size() == kSweepCells + 1);
  std::map<std::string, std::size_t> column;
  for (std::size_t i = 0; i < rows[0].size(); ++i) column[rows[0][i]] = i;
  CHECK(column.size() == rows[0].size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    REQUIRE(rows[i].size() == rows[0].size());
    const auto& row = rows[i];
    CHECK(row[column.at("status")] == "done");
    const Json report =
        ReadJson(out + "/cells/" + row[column.at("cell")] + "/report.json");
    CHECK(row[column.at("samples")] == report["samples"].dump());
    CHECK(std::stod(row[column.at("samples")]) ==
          48 * 36 * std::stod(row[column.at("spp")]));
    CHECK(std::stod(row[column.at("render_seconds")]) == report["seconds"]["render"]);
    CHECK(std::stod(row[column.at("relmse_high")]) == report["error"]["relmse"]["high"]);
    CHECK(std::stod(row[column.at("relmse_low")]) <= std::stod(row[column.at("relmse")]));
    CHECK(row[column.at("used_seed")] == row[column.at("seed")]);
    CHECK(row[column.at("time_seconds")].empty());
    CHECK(std::stod(row[column.at("stage_camera_perspective_cpu_seconds")]) > 0);
  }
}

TEST_CASE("sweep: what is done is not done again", "[sweep][cli]") {
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

TEST_CASE("sweep: clocks do not matter", "[sweep][cli]") {
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
  CHECK_THAT(r.err, Contains("11 of the directories") && Contains("seed1"));
  CHECK(CsvRows(out + "/sweep.csv").size() == kSweepCells + 1);
  CHECK_THAT(Contents(out + "/sweep.csv"), !Contains("seed1"));
  CHECK(Contents(out + "/sweep.toml") == Contents(file));
}

TEST_CASE("sweep: cells rendered otherwise are refused", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  const std::string old = Contents(file);
  WriteText(file, old + "[settings]\ncrop = [0, 0, 8, 8]\n");
  const ProcessResult crop = Sweep(file, out);
  CHECK(crop.exit_code == kExitBadInput);
  CHECK_THAT(crop.err, Contains("crop is not set there and \"0,0,8,8\" here") &&
                           Contains("cells/") && Contains("another --out"));
  WriteText(file, old);
  Replace(directory / "other.pbrt", "0.5 0.4 0.3", "0.5 0.4 0.2");
  const ProcessResult scene = Sweep(file, out);
  CHECK(scene.exit_code == kExitBadInput);
  CHECK_THAT(scene.err, Contains("hash of the scene's files") && Contains("/other_"));
  CHECK_THAT(Sweep(file, out, {"--table-only"}).err, Contains("rendered otherwise"));
  WriteText(out + "/cells/" + DoneCells(out).back() + "/report.json", "{\"half\": ");
  Replace(directory / "other.pbrt", "0.5 0.4 0.2", "0.5 0.4 0.3");
  CHECK_THAT(Sweep(file, out).err, Contains("is not a report of a sweep"));
}

TEST_CASE("sweep: a cell that fails does not stop the others", "[sweep][cli]") {
  const TempDirectory directory;
  WriteSphereScene(directory);
  WriteText(directory / "broken.pbrt", "WorldBegin\nShape \"sphear\"\n");
  const std::string file = WriteText(directory / "sweep.toml", R"([grid]
scene = ["broken.pbrt", "sphere.pbrt"]
spp = [1, 2]
)");
  const std::string out = directory / "out";
  const ProcessResult r = Sweep(file, out);
  CHECK(r.exit_code == kExitBadInput);
  CHECK(RenderedBy(r) == 2);
  CHECK_THAT(r.err, Contains("failed: broken_1spp") && Contains(" and 1 more: ") &&
                        Contains("broken.pbrt:2:7") && Contains("sphear"));
  CHECK_THAT(Contents(out + "/sweep.csv"), Contains(",failed,") && Contains("sphear"));
  // Tried again, and done now.
  WriteText(directory / "broken.pbrt", Contents(directory / "sphere.pbrt"));
  const ProcessResult again = Sweep(file, out);
  INFO(again.err);
  CHECK(again.exit_code == kExitGood);
  CHECK(RenderedBy(again) == 2);
  for (const std::string& name : DoneCells(out)) {
    CHECK_FALSE(fs::exists(out + "/cells/" + name + "/error.json"));
  }
}

TEST_CASE("sweep: parts are disjoint and make the whole", "[sweep][cli]") {
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

TEST_CASE("sweep: Ctrl-C gives up a cell and says so to schedulers", "[sweep][cli]") {
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
    CHECK_THAT(r.err, Contains("given up"));
    CHECK(DoneCells(out).size() < kSweepCells);
    CHECK(Rubbish(out).empty());
    CHECK(fs::exists(out + "/sweep.csv"));
  }
}

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
  // fcntl(F_OFD_SETLK) fails as it does there.
  options.prepare = [] {
    sock_filter code[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_fcntl, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[1])),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, F_OFD_SETLK, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOLCK),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog program = {sizeof(code) / sizeof(code[0]), code};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) _exit(126);
    if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) _exit(126);
  };
  const ProcessResult r = Sweep(file, out, {}, options);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("has no locks") && Contains("--part I/N"));
  CHECK(RenderedBy(Sweep(file, out, {"--part", "1/2"}, options)) == 11);
  CHECK(RenderedBy(Sweep(file, out, {"--part", "2/2"}, options)) == 11);
}

TEST_CASE("sweep: a dry run predicts and renders nothing", "[sweep][cli]") {
  const TempDirectory directory;
  const std::string file = WriteSweep(directory), out = directory / "out";
  ProcessOptions options;
  options.temp_directory = directory.path();
  const auto files = directory.Files();
  const ProcessResult r = Sweep(file, out, {"--dry-run"}, options);
  INFO(r.out << r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("22 cells, 2 combinations excluded; 0 are done") &&
                        Contains("6 of 6 combinations") && Contains("hours"));
  CHECK(directory.Files() == files);
  const ProcessResult few = Sweep(file, out, {"--dry-run", "--pilots", "2"}, options);
  CHECK_THAT(few.out, Contains("2 of 6 combinations") && Contains("(~) are judged"));
  const ProcessResult none = Sweep(file, out, {"--dry-run", "--pilots", "0"}, options);
  CHECK_THAT(none.out, !Contains("hours") && Contains("22 cells"));
  REQUIRE(Sweep(file, out).exit_code == kExitGood);
  CHECK_THAT(Sweep(file, out, {"--dry-run"}).out, Contains("22 are done"));
}

}  // namespace lanelight
