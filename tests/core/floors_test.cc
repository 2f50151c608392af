// The floors of the project: a folder includes only itself and what stands before it in
// this list.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace lanelight {
namespace {

namespace fs = std::filesystem;

struct Floor {
  const char *folder, *holds;
};

// clang-format off
constexpr Floor kFloors[] = {
    {"src/core",           "checks, errors, threads, vectors"},
    {"src/stat",           "intervals, tests, orders of convergence"},
    {"src/strategy",       "the vocabulary of strategies"},
    {"src/path",           "what a path is: fields, stages, dimensions, features"},
    {"src/image",          "films, image files, spectra"},
    {"src/state",          "files of a render's state"},
    {"src/report",         "pages and plots of what was measured"},
    {"src/compare",        "two images, and what sets them apart"},
    {"src/scene",          "what a scene file says"},
    {"src/parse",          "text to description"},
    {"src/geometry",       "shapes as kernels read them"},
    {"src/accel",          "trees over shapes"},
    {"src/compiled",       "scenes as kernels read them"},
    {"src/compile",        "description to compiled scene"},
    {"src/prepare",        "what a strategy adds to a scene"},
    {"kernels/simd",       "lanes, vectors, elementary functions"},
    {"kernels/peaks",      "what the machine can do"},
    {"kernels/warp",       "sampling routines"},
    {"kernels/queue",      "the loop over a queue"},
    {"kernels/texture",    "textures"},
    {"kernels/points",     "sample points"},
    {"kernels/pairs",      "antithetic pairs"},
    {"kernels/generate",   "camera rays"},
    {"kernels/intersect",  "rays and shapes"},
    {"kernels/surface",    "where a ray hit"},
    {"kernels/sort",       "paths into queues"},
    {"kernels/bsdf",       "materials, as policies"},
    {"kernels/directions", "the next direction, and its weight"},
    {"kernels/lights",     "light samples, emission"},
    {"kernels/media",      "participating media"},
    {"kernels/shade",      "materials, as stages"},
    {"kernels/control",    "control variates"},
    {"kernels/roulette",   "roulette and splitting"},
    {"kernels/accumulate", "finished samples"},
    {"kernels/reuse",      "paths that serve a block of pixels"},
    {"kernels/probe",      "kernel routines outside a render"},
    {"kernels",            "the registry of stages"},
    {"src/plan",           "which stages and columns a scene needs"},
    {"src/wave",           "paths of a task from stage to stage"},
    {"src/train",          "passes before a render, and what they decide"},
    {"src/run",            "tasks, rounds, threads and ranks"},
    {"src/estimate",       "errors, when to stop"},
    {"src/render",         "a job from settings to outputs"},
    {"src/ranks",          "processes that render together"},
    {"src/throughput",     "how fast scenes render"},
    {"src/sweep",          "grids of renders"},
    {"src/study",          "measuring strategies"},
    {"src/advise",         "choosing one"},
    {"src/live",           "a page that renders while it is looked at"},
    {"src/stress",         "extremes, measured and judged"},
    {"src/stress/cases",   "what is extreme, and what must be true there"},
    {"src/cli",            "flags and text"},
    {"src",                "main"},
};
// clang-format on

// Headers of a folder that stand on the ground: they include nothing of the project
// but src/core.
const std::set<std::string> kGround = {"kernels/targets.h"};

// Position in the list; -1 if it is not there.
int FloorOf(const std::string& folder) {
  const auto* found = std::find_if(std::begin(kFloors), std::end(kFloors),
                                   [&](const Floor& f) { return f.folder == folder; });
  return found == std::end(kFloors) ? -1 : static_cast<int>(found - kFloors);
}

std::string Folder(const std::string& file) {
  return fs::path(file).parent_path().generic_string();
}

/// What is wrong with `text`, the contents of `file`; empty if nothing.
std::string UpwardIncludes(const std::string& file, const std::string& text) {
  static const std::regex include(
      R"re(#include "((?:src|kernels|tests|bench)/[^"]+)")re");
  const std::string from = Folder(file);
  if (FloorOf(from) < 0) return file + ": its folder has no floor\n";
  std::string wrong;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
    const std::string target = (*it)[1], to = Folder(target);
    if (to == from) continue;
    if (kGround.count(target) > 0) continue;
    if (FloorOf(to) < 0 || FloorOf(to) >= FloorOf(from)) {
      wrong += file + " includes " + target + "\n";
    }
  }
  return wrong;
}

std::string Contents(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a folder includes only folders below it", "[floors]") {
  const fs::path root = LANELIGHT_SOURCE_DIR;
  int files = 0;
  for (const char* top : {"src", "kernels"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cc") continue;
      const std::string name = fs::relative(entry.path(), root).generic_string();
      CHECK(UpwardIncludes(name, Contents(entry.path())) == "");
      ++files;
    }
  }
  CHECK(files > 300);
}

TEST_CASE("an include of a folder above is found", "[floors]") {
  CHECK(UpwardIncludes("src/render/job.h", "#include \"src/estimate/target.h\"\n") == "");
  CHECK(UpwardIncludes("src/render/job.h", "#include \"src/study/runs.h\"\n") ==
        "src/render/job.h includes src/study/runs.h\n");
  CHECK(UpwardIncludes("src/study/runs.h", "#include \"src/advise/advise.h\"\n") != "");
  CHECK(UpwardIncludes("src/path/wave.h", "#include \"kernels/stages.h\"\n") != "");
  CHECK(UpwardIncludes("kernels/simd/vec3-inl.h",
                       "#include \"kernels/queue/batch-inl.h\"\n") != "");
  CHECK(UpwardIncludes("src/core/check.h", "#include \"tests/stat/chi2.h\"\n") != "");
  CHECK(UpwardIncludes("src/attic/old.h", "") != "");
}

}  // namespace lanelight
