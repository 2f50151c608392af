// The layers of the project (src/*/README.md): a folder includes only itself and what
// stands before it in this list.
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

struct Folder {
  const char *folder, *holds;
};

// clang-format off
constexpr Folder kFolders[] = {
    {"src/base/core",           "checks, errors, threads, vectors"},
    {"src/base/stat",           "intervals, tests, orders of convergence"},
    {"src/base/image",          "image files, spectra"},
    {"src/base/state",          "files of a render's state"},
    {"src/vocabulary/strategy", "the choices of strategies"},
    {"src/vocabulary/path",     "fields, stages, dimensions and features of paths"},
    {"src/scene/description",   "what a scene file says"},
    {"src/scene/parse",         "text to description"},
    {"src/scene/geometry",      "shapes and BVH as kernels read them"},
    {"src/scene/accel",         "BVH build"},
    {"src/scene/compiled",      "scenes as kernels read them"},
    {"src/scene/compile",       "description to compiled scene"},
    {"src/scene/prepare",       "what a strategy adds to a scene"},
    {"kernels/simd",            "lanes, vectors, elementary functions"},
    {"kernels/peaks",           "what the machine can do"},
    {"kernels/warp",            "sampling routines"},
    {"kernels/queue",           "the loop over a queue"},
    {"kernels/texture",         "textures"},
    {"kernels/samplers",          "sample points"},
    {"kernels/antithetic",      "antithetic pairs"},
    {"kernels/generate",        "camera rays"},
    {"kernels/intersect",       "rays and shapes"},
    {"kernels/surface",         "where a ray hit"},
    {"kernels/sort",            "paths into queues"},
    {"kernels/bsdf",            "materials, as policies"},
    {"kernels/directions",      "the next direction, and its weight"},
    {"kernels/lights",          "light samples, emission"},
    {"kernels/media",           "participating media"},
    {"kernels/shade",           "materials, as stages"},
    {"kernels/control",         "control variates"},
    {"kernels/roulette",        "roulette and splitting"},
    {"kernels/accumulate",      "finished samples"},
    {"kernels/reuse",           "paths that serve a block of pixels"},
    {"kernels/light_paths",     "light subpaths"},
    {"kernels",                 "the registry of stages"},
    {"src/render/films",        "sums of samples"},
    {"src/render/plan",         "which stages and columns a scene needs"},
    {"src/render/wave",         "paths of a task from stage to stage"},
    {"src/render/train",        "passes before a render, and what they decide"},
    {"src/render/schedule",     "rounds, and ranges of samples for threads"},
    {"src/render/ranks",        "rounds of several processes"},
    {"src/render/run",          "a run from its options to its result"},
    {"src/render/estimate",     "errors, when to stop"},
    {"src/render/job",          "a job from settings to outputs"},
    {"src/render/mpi",          "ranks that MPI started"},
    {"src/measure/report",      "pages and plots"},
    {"src/measure/compare",     "differences of two images"},
    {"src/measure/throughput",  "how fast scenes render"},
    {"src/measure/profile",     "comparing profiles"},
    {"src/measure/sweep",       "grids of renders"},
    {"src/measure/study",       "measuring strategies"},
    {"src/measure/live",        "a page that renders while it is looked at"},
    {"src/measure/stress",      "extremes, measured and judged"},
    {"src/measure/stress/cases", "extreme inputs with known results"},
    {"src/cli",                 "flags and text"},
    {"src",                     "main"},
};
// clang-format on

// Headers that every folder may include: they include nothing of the project but
// src/base/core.
const std::set<std::string> kEverywhere = {"kernels/targets.h"};

// Position in the list; -1 if it is not there.
int PlaceOf(const std::string& folder) {
  const auto* found = std::find_if(std::begin(kFolders), std::end(kFolders),
                                   [&](const Folder& f) { return f.folder == folder; });
  return found == std::end(kFolders) ? -1 : static_cast<int>(found - kFolders);
}

std::string FolderOf(const std::string& file) {
  return fs::path(file).parent_path().generic_string();
}

/// What is wrong with `text`, the contents of `file`; empty if nothing.
std::string UpwardIncludes(const std::string& file, const std::string& text) {
  static const std::regex include(
      R"re(#include "((?:src|kernels|tests|bench)/[^"]+)")re");
  const std::string from = FolderOf(file);
  if (PlaceOf(from) < 0) return file + ": its folder is not in the list\n";
  std::string wrong;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
    const std::string target = (*it)[1], to = FolderOf(target);
    if (to == from) continue;
    if (kEverywhere.count(target) > 0) continue;
    if (PlaceOf(to) < 0 || PlaceOf(to) >= PlaceOf(from)) {
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

TEST_CASE("a folder includes only folders below it", "[layers]") {
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

TEST_CASE("an include of a higher folder is detected", "[layers]") {
  CHECK(UpwardIncludes("src/render/job/job.h",
                       "#include \"src/render/estimate/target.h\"\n") == "");
  CHECK(
      UpwardIncludes("src/render/job/job.h", "#include \"src/measure/study/runs.h\"\n") ==
      "src/render/job/job.h includes src/measure/study/runs.h\n");
  CHECK(UpwardIncludes("src/measure/study/runs.h",
                       "#include \"src/measure/live/server.h\"\n") != "");
  CHECK(UpwardIncludes("src/vocabulary/path/wave.h", "#include \"kernels/stages.h\"\n") !=
        "");
  CHECK(UpwardIncludes("kernels/simd/vec3-inl.h",
                       "#include \"kernels/queue/batch-inl.h\"\n") != "");
  CHECK(UpwardIncludes("src/base/core/check.h",
                       "#include \"tests/base/stat/chi2.h\"\n") != "");
  CHECK(UpwardIncludes("src/attic/old.h", "") != "");
}

}  // namespace lanelight
