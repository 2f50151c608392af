// Ten thousand cells: counted, named, looked at and put into a table in seconds.
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <set>
#include <unistd.h>

#include "src/base/core/input_file.h"
#include "src/measure/sweep/runner.h"
#include "src/measure/sweep/sweep_folder.h"
#include "tests/measure/sweep/sweep_folder.h"

namespace lanelight {
namespace {

std::string Numbers(int n) {
  std::string list;
  for (int i = 1; i <= n; ++i) list += std::to_string(i) + ",";
  return "[" + list + "]";
}

// Temporary directories are in memory: what a disk takes for 20000 new files is not what
// this is about.
class InMemory {
 public:
  InMemory() {
    if (const char* folder = std::getenv("TMPDIR")) had_ = folder;
    if (access(kFolder, W_OK) == 0) setenv("TMPDIR", kFolder, 1);
  }
  ~InMemory() {
    if (had_) {
      setenv("TMPDIR", had_->c_str(), 1);
    } else {
      unsetenv("TMPDIR");
    }
  }
  InMemory(const InMemory&) = delete;
  InMemory& operator=(const InMemory&) = delete;

 private:
  static constexpr const char* kFolder = "/dev/shm";
  std::optional<std::string> had_;
};

class Stopwatch {
 public:
  double Seconds() const {
    const std::chrono::duration<double> d = std::chrono::steady_clock::now() - start_;
    return d.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

TEST_CASE("sweep: ten thousand cells", "[sweep]") {
  const InMemory in_memory;
  const TempDirectory directory;
  WriteSphereScene(directory);
  const Stopwatch watch;
  const Sweep sweep = ParseSweep(
      directory / "sweep.toml",
      "[grid]\nscene = 'sphere.pbrt'\nresolution = '8x6'\nmax-depth = [1, 2, 3, 4]\n"
      "strategy = ['default', 'points=stratified', 'points=halton', 'directions=bsdf', "
      "'points=independent']\nspp = " +
          Numbers(5) + "\nseed = " + Numbers(101) + "\n[[exclude]]\nseed = 101\n");
  REQUIRE(sweep.cells.size() == 10000);
  CHECK(sweep.excluded == 100);
  std::set<std::string> names;
  for (const SweepCell& cell : sweep.cells) names.insert(cell.name);
  CHECK(names.size() == 10000);

  const std::atomic<bool> stop = false;
  const SweepPrediction prediction = Predict(sweep, directory / "out", 0, stop);
  CHECK(prediction.combinations == 20);
  CHECK(PredictionText(sweep, prediction).size() > 10000 * 40);

  // One is rendered; the others get its report, as if they had been.
  Sweep one = sweep;
  one.cells.resize(1);
  REQUIRE(RunSweep(one, {directory / "out"}, {}).done == 1);
  const SweepFolder folder(directory / "out", sweep);
  nlohmann::json report = ReadJson(folder.File(sweep.cells[0], "report.json"));
  nlohmann::json own = report["sweep"];
  report.erase("sweep");
  const std::string image = folder.File(sweep.cells[0], "image.exr");
  std::string start = report.dump();
  start.pop_back();
  for (std::size_t i = 1; i < sweep.cells.size(); ++i) {
    // Not Finish(), which waits for the disk.
    const SweepCell& cell = sweep.cells[i];
    own["name"] = cell.name;
    for (const Axis axis : {Axis::kMaxDepth, Axis::kStrategy, Axis::kSpp, Axis::kSeed}) {
      own["values"][Key(axis)] = *Get(cell.values, axis);
    }
    folder.MakeCell(cell);
    std::filesystem::create_hard_link(image, folder.File(cell, "image.exr"));
    if (i == 5000) continue;
    WriteText(folder.File(cell, "report.json"), start + ",\"sweep\":" + own.dump() + "}");
  }
  const SweepOutcome outcome = RunSweep(sweep, {directory / "out"}, {});
  CHECK(outcome.rendered == 1);  // the one that was left out
  CHECK(outcome.done == 10000);
  CHECK(outcome.failures.empty());
  const std::string table = ReadWholeFile(directory / "out/sweep.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 10001);
  CHECK(std::filesystem::file_size(directory / "out/report.html") < 8'000'000);
}

}  // namespace lanelight
