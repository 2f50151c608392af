// `--build-cache` from the outside: the same images, fewer builds.
#include <catch2/catch.hpp>
#include <thread>

#include "src/cli/exit_codes.h"
#include "src/image/exr.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Contains;
namespace fs = std::filesystem;

struct Rendered {
  std::vector<float> pixels;
  std::string origin, err;
};

Rendered RenderWith(const std::string& scene, const std::vector<std::string>& more) {
  const TempDirectory directory;
  std::vector<std::string> arguments = {"render",       scene,
                                        "-o",           directory / "a.exr",
                                        "--json",       directory / "a.json",
                                        "--resolution", "32x24",
                                        "--spp",        "2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const bool quiet = !more.empty() && more.back() == "--quiet";
  if (!quiet) arguments.emplace_back("-v");
  const ProcessResult r = RunLanelight(arguments);
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  const Image image = ReadExr(directory / "a.exr");
  const nlohmann::json report = test::ReadJson(directory / "a.json");
  CHECK(report.at("seconds").at("trees") <= report.at("seconds").at("build"));
  const std::string origin = report.at("trees").at("origin");
  if (!quiet) {
    CHECK_THAT(r.out, Contains("(trees " + origin + " in "));
  }
  return {{image.pixels.begin(), image.pixels.end()}, origin, r.err};
}

std::vector<fs::path> TreesIn(const std::string& cache) {
  std::vector<fs::path> trees;
  for (const auto& entry : fs::directory_iterator(cache)) {
    if (entry.path().extension() == ".tree") trees.push_back(entry.path());
  }
  return trees;
}

// "built" or the like: how many cells.
std::map<std::string, int> OriginsOfSweep(const std::string& file, const std::string& out,
                                          const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"sweep", file, "--out", out, "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProcessResult r = RunLanelight(arguments);
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  std::map<std::string, int> origins;
  for (const auto& cell : fs::directory_iterator(out + "/cells")) {
    ++origins[test::ReadJson(cell.path() / "report.json").at("trees").at("origin")];
  }
  return origins;
}

}  // namespace

TEST_CASE("images through mapped trees are those through built ones", "[cli]") {
  const TempDirectory directory;
  const std::string cache = directory / "cache";
  for (const char* name : {"cornell-box", "instances", "shapes", "relief", "lights"}) {
    CAPTURE(name);
    const std::string scene =
        LANELIGHT_SOURCE_DIR "/scenes/" + std::string(name) + ".pbrt";
    const Rendered without = RenderWith(scene, {});
    const Rendered cold = RenderWith(scene, {"--build-cache", cache});
    const Rendered warm = RenderWith(scene, {"--build-cache", cache});
    CHECK(without.origin == "built");
    CHECK(cold.origin == "built");
    CHECK(warm.origin == "mapped");
    CHECK(cold.pixels == without.pixels);
    CHECK(warm.pixels == without.pixels);
    CHECK_THAT(warm.err, !Contains("--build-cache"));
  }
  CHECK(TreesIn(cache).size() == 5);
}

TEST_CASE("a tree file that is not whole is refused in one line, and made anew",
          "[cli]") {
  const TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), cache = directory / "cache";
  const Rendered built = RenderWith(scene, {"--build-cache", cache});
  const fs::path file = TreesIn(cache).at(0);
  fs::resize_file(file, fs::file_size(file) - 100);
  const Rendered again = RenderWith(scene, {"--build-cache", cache});
  CHECK_THAT(again.err,
             Contains("--build-cache: note: " + file.string() + ": the tree is torn") &&
                 Contains("the trees were built anew\n"));
  CHECK(again.origin == "built");
  CHECK(again.pixels == built.pixels);
  CHECK(RenderWith(scene, {"--build-cache", cache, "--quiet"}).origin == "mapped");
  const Rendered nowhere = RenderWith(scene, {"--build-cache", scene});
  CHECK_THAT(nowhere.err, Contains("Not a directory; the trees are not kept"));
  CHECK(nowhere.pixels == built.pixels);
}

TEST_CASE("a limit removes the trees that were used least recently", "[cli]") {
  const TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), cache = directory / "cache";
  const auto render = [&](const char* build, const char* size) {
    return RenderWith(
        scene, {"--build", build, "--build-cache", cache, "--build-cache-size", size});
  };
  CHECK(render("high", "1kB").origin == "built");
  const fs::path first = TreesIn(cache).at(0);  // larger than that, and there
  CHECK(render("high", "1kB").origin == "mapped");
  fs::last_write_time(first, fs::last_write_time(first) - std::chrono::hours(1));
  CHECK(render("fast", "0").origin == "built");
  CHECK(TreesIn(cache).size() == 2);
  fs::remove(first);
  WriteText(cache + "/notes.tree", std::string(10000, 'x'));
  CHECK(render("high", "1 KiB").origin == "built");
  CHECK(TreesIn(cache).size() == 2);
  CHECK(fs::exists(first));
  CHECK(fs::exists(cache + "/notes.tree"));
}

TEST_CASE("processes share a directory of trees", "[cli]") {
  const TempDirectory directory;
  const std::string cache = directory / "cache";
  const std::string scene = LANELIGHT_SOURCE_DIR "/scenes/relief.pbrt";
  std::vector<ProcessResult> results(3);
  std::vector<std::thread> threads;
  for (ProcessResult& result : results) {
    threads.emplace_back([&] {
      result =
          RunLanelight({"plan", scene, "--resolution", "32x24", "--build-cache", cache});
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const ProcessResult& result : results) CHECK(result.exit_code == kExitGood);
  CHECK(TreesIn(cache).size() == 1);
  CHECK(RenderWith(scene, {"--build-cache", cache}).origin == "mapped");
}

TEST_CASE("a sweep over one scene builds its trees once", "[cli][sweep]") {
  const TempDirectory directory;
  WriteSphereScene(directory);
  const std::string file = WriteText(directory / "sweep.toml", R"([grid]
scene = "sphere.pbrt"
resolution = ["16x12", "24x18"]
max-depth = [1, 2]
spp = 2
)");
  using Origins = std::map<std::string, int>;
  CHECK(OriginsOfSweep(file, directory / "a", {}) ==
        Origins{{"built", 1}, {"shared", 3}});
  const std::vector<std::string> cached = {"--build-cache", directory / "cache"};
  CHECK(OriginsOfSweep(file, directory / "b", cached) ==
        Origins{{"built", 1}, {"shared", 3}});
  CHECK(OriginsOfSweep(file, directory / "c", cached) ==
        Origins{{"mapped", 1}, {"shared", 3}});
}

}  // namespace lanelight
