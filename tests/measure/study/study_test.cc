// Studies from start to end, on a scene of a few pixels.
#include "src/measure/study/study.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/base/core/input_file.h"
#include "src/measure/study/scene_runner.h"
#include "src/render/films/colors.h"
#include "src/render/job/machine_json.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/measure/study/study_file.h"

namespace lanelight {
namespace {

using Catch::Contains;
using Catch::EndsWith;
using Json = nlohmann::json;

constexpr const char* kStudyScene = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 12 "integer yresolution" 8 "string filename" "x.exr"
WorldBegin
LightSource "infinite" "rgb L" [0.5 0.6 0.8]
Material "diffuse" "rgb reflectance" [0.7 0.5 0.3]
Shape "sphere" "float radius" 1
AttributeBegin
  Translate 0 2.5 0
  AreaLightSource "diffuse" "rgb L" [6 6 6]
  Shape "sphere" "float radius" 0.4
AttributeEnd
)";

StudyOptions TinyStudy(const TemporaryFolder& folder, const std::string& out) {
  StudyOptions options;
  options.scenes = {folder.Write("tiny.pbrt", kStudyScene)};
  options.strategies = {"paper-plain", "default", "points=halton"};
  options.spp = {1, 4, 16};
  options.repetitions = 3;
  options.out = folder.File(out);
  return options;
}

void CheckNumbers(const Json& json) {
  if (json.is_number_float()) CHECK(std::isfinite(json.get<double>()));
  if (json.is_string()) CHECK_THAT(json.get<std::string>(), !Contains("nan"));
  if (json.is_structured()) {
    for (const Json& child : json) CheckNumbers(child);
  }
}

int Lines(const std::string& path) {
  std::ifstream in(path);
  int lines = 0;
  for (std::string line; std::getline(in, line);) ++lines;
  return lines;
}

}  // namespace

TEST_CASE("a study writes numbers, rows, images and a report", "[study]") {
  const TemporaryFolder folder;
  const StudyOptions options = TinyStudy(folder, "out");
  const auto studies = Study(options, {});
  REQUIRE(studies.size() == 1);
  REQUIRE(studies[0].runs.error.empty());
  const Json json = ReadJson(options.out + "/study.json");
  CHECK(json["schema"] == 1);
  CheckNumbers(json);
  const Json& scene = json["scenes"][0];
  REQUIRE(scene["strategies"].size() == 3);
  CHECK(scene["name"] == "tiny");
  CHECK(scene["reference"]["source"] == "rendered");
  CHECK(scene["reference"]["relmse"].get<double>() > 0);
  CHECK(scene["ranking"].size() == 3);
  CHECK(scene["bias"]["failed"] == 0);
  CHECK(scene["diffuse"].empty());  // only on the page of --paper
  for (const Json& strategy : scene["strategies"]) {
    INFO(strategy["name"]);
    CHECK(strategy["status"] == "ok");
    CHECK(strategy["at_spp"] == 16);
    REQUIRE(strategy["levels"].size() == 3);
    CHECK(strategy["levels"][2]["repetitions"] == 3);
    CHECK(strategy["levels"][2]["relmse"]["value"].get<double>() <
          strategy["levels"][0]["relmse"]["value"].get<double>());
    CHECK(strategy["order"]["value"].get<double>() < -0.3);
    for (const char* efficiency : {"efficiency", "efficiency_trimmed"}) {
      CHECK(strategy[efficiency]["value"].get<double>() > 0.01);
      CHECK(strategy[efficiency]["value"].get<double>() < 100);
    }
    for (const char* image : {"mean", "one", "variance", "bias"}) {
      const std::string name = strategy["images"][image];
      CHECK(std::filesystem::exists(options.out + "/" + name + ".exr"));
    }
  }
  const Json here = ToJson(ThisMachine());
  CHECK(scene["machines"] == Json::array({here}));
  for (const auto& [name, value] : here.items()) CHECK(json["machine"][name] == value);
  CHECK(json["machine"]["threads"].get<int>() > 0);
  const std::string table = ReadWholeFile(options.out + "/study.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 1 + 3 * 3 * 3);
  CHECK_THAT(table, Contains("," + MachineCsvHeader() + "\n") &&
                        EndsWith("," + MachineCsvRow(ThisMachine()) + "\n"));
  CHECK(std::filesystem::file_size(options.out + "/report.html") > 0);
}

TEST_CASE("a continued study is the same, up to timings", "[study]") {
  const TemporaryFolder folder;
  Study(TinyStudy(folder, "whole"), {});
  Json whole = ReadJson(folder.File("whole") + "/study.json");
  RemoveTimings(whole);

  for (int stop_after : {1, 6, 13, 22, 29}) {
    INFO(stop_after);
    const std::string name = "part" + std::to_string(stop_after);
    StudyOptions options = TinyStudy(folder, name);
    std::atomic<bool> stop = false;
    int steps = 0;
    StudyHooks hooks;
    hooks.stop = &stop;
    hooks.on_progress = [&](const StudyProgress&) { stop = ++steps >= stop_after; };
    Study(options, hooks);
    const Json part = ReadJson(options.out + "/study.json");
    CheckNumbers(part);
    CHECK(part["scenes"][0]["interrupted"] == true);

    options.resume = true;
    int cells = 0;
    hooks.stop = nullptr;
    hooks.on_progress = [&](const StudyProgress& p) {
      cells += p.what.find("repetition") != std::string::npos;
    };
    Study(options, hooks);
    CHECK(cells <= 27);
    if (stop_after >= 13) CHECK(cells < 27);  // nothing finished is done again
    Json resumed = ReadJson(options.out + "/study.json");
    RemoveTimings(resumed);
    INFO(Json::diff(whole, resumed).dump(1));
    CHECK((resumed == whole));
  }
}

TEST_CASE("a study can be extended but not mixed with another", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "out");
  options.repetitions = 1;
  Study(options, {});
  CHECK_THROWS_WITH(Study(options, {}), Contains("--resume"));
  options.resume = true;
  options.repetitions = 2;
  options.strategies.push_back("points=stratified");
  const auto studies = Study(options, {});
  REQUIRE(studies[0].analysis.strategies.size() == 4);
  CHECK(studies[0].analysis.strategies[3].AtLevel().repetitions == 2);
  options.settings.max_depth = 2;
  CHECK_THROWS_WITH(Study(options, {}), Contains("max_depth"));
}

TEST_CASE("unsupported strategies are reported, and the study continues", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "out");
  options.scenes.push_back(folder.File("missing.pbrt"));
  options.scenes.push_back(
      folder.Write("dark.pbrt",
                   "Film \"rgb\" \"integer xresolution\" 4 \"integer "
                   "yresolution\" 4\nWorldBegin\nShape \"sphere\"\n"));
  options.strategies = {"reuse=block,roulette=adjoint", "default",
                        "reuse=block,control=regression"};
  options.spp = {1, 4};
  options.repetitions = 2;
  const auto studies = Study(options, {});
  const Json json = ReadJson(options.out + "/study.json");
  CheckNumbers(json);
  CHECK_THAT(json["scenes"][1]["error"].get<std::string>(), Contains("missing.pbrt"));
  // A scene without light is black: no error, nothing to rank, no division by zero.
  const Json& dark = json["scenes"][2];
  CHECK(dark["error"].is_null());
  CHECK(dark["strategies"][0]["status"] == "refused");
  CHECK_FALSE(dark["strategies"][0]["message"].get<std::string>().empty());
  CHECK(dark["strategies"][1]["levels"][0]["relmse"]["value"] == 0);
  CHECK_THAT(dark["verdict"].get<std::string>(),
             Contains("No strategy differs from the reference"));
}

TEST_CASE("equivalent strategies of a scene are rendered once", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "out");
  const std::string text = kStudyScene;
  const std::size_t environment = text.find("LightSource \"infinite\"");
  const std::string one_light =
      text.substr(0, environment) + text.substr(text.find("Material"));
  options.scenes.push_back(folder.Write("lamp.pbrt", one_light));
  options.strategies = {"default", "light-selection=uniform", "points=halton", "scene"};
  options.spp = {2};
  options.repetitions = 2;
  const auto studies = Study(options, {});
  const Json json = ReadJson(options.out + "/study.json");
  const Json &two = json["scenes"][0]["strategies"],
             &one = json["scenes"][1]["strategies"];
  CHECK(two[1]["status"] == "ok");
  CHECK(two[1]["same_as"].is_null());
  CHECK(one[1]["status"] == "same");
  CHECK(one[1]["same_as"] == 0);
  CHECK(one[1]["levels"].empty());
  CHECK_THAT(one[1]["message"].get<std::string>(), Contains("fewer than two lights"));
  for (const Json& scene : json["scenes"]) {
    // The scene says nothing of its own.
    CHECK(scene["strategies"][3]["status"] == "same");
    CHECK(scene["strategies"][3]["message"] == "is default");
  }
  CHECK(json["scenes"][1]["ranking"].size() == 2);
  CHECK(Lines(options.out + "/study.csv") == 1 + 2 * 3 + 2 * 2);
}

TEST_CASE("a study is not continued without one of its scenes", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "out");
  options.spp = {1};
  options.repetitions = 1;
  Study(options, {});
  options.resume = true;
  const std::string first = options.scenes[0];
  options.scenes = {folder.Write("other.pbrt", kStudyScene)};
  CHECK_THROWS_WITH(Study(options, {}),
                    Contains("'tiny'") && Contains("name that scene"));
  CHECK_FALSE(std::filesystem::exists(options.out + "/other"));
  options.scenes.insert(options.scenes.begin(), first);
  CHECK(Study(options, {}).size() == 2);
}

TEST_CASE("a damaged reference of a study is reported with a remedy", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "out");
  options.spp = {2};
  Study(options, {});
  Json before = ReadJson(options.out + "/study.json");
  const std::string path = options.out + "/tiny/reference.exr";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  options.resume = true;
  CHECK_THROWS_WITH(Study(options, {}),
                    Contains(path) && Contains("remove") && Contains("--resume"));
  std::filesystem::remove(path);
  Study(options, {});
  Json after = ReadJson(options.out + "/study.json");
  RemoveTimings(before);
  RemoveTimings(after);
  CHECK((before == after));
}

TEST_CASE("errors against a given reference", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "first");
  Study(options, {});
  options.references = {folder.File("first") + "/tiny/reference.exr"};
  options.out = folder.File("second");
  const auto studies = Study(options, {});
  const Json json = ReadJson(options.out + "/study.json");
  CHECK(json["scenes"][0]["reference"]["source"] == "file");
  CHECK(json["scenes"][0]["reference"]["independent"] == true);
  const Json first = ReadJson(folder.File("first") + "/study.json");
  CHECK(json["scenes"][0]["strategies"][1]["levels"][2]["relmse"] ==
        first["scenes"][0]["strategies"][1]["levels"][2]["relmse"]);
  CHECK_FALSE(std::filesystem::exists(options.out + "/tiny/cells/reference.exr"));
}

TEST_CASE("a wrong reference is reported as such, not as biased strategies", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "first");
  const auto right = Study(options, {});
  std::vector<Rgb> wrong = right[0].runs.reference.mean;
  for (Rgb& c : wrong) c *= 1.2;
  WriteColors(folder.File("wrong.exr"), 12, 8, {{"", &wrong}});
  options.references = {folder.File("wrong.exr")};
  options.out = folder.File("second");
  const auto studies = Study(options, {});
  CHECK(studies[0].analysis.biased.empty());
  CHECK(studies[0].analysis.biased_alike.size() == 3);
  CHECK_THAT(studies[0].analysis.verdict, Contains("the reference may be wrong"));
  const Json json = ReadJson(options.out + "/study.json");
  CHECK(json["scenes"][0]["bias"]["alike"] == Json({0, 1, 2}));
  // With no other strategy to compare, the reference counts as right.
  options.strategies = {"default"};
  options.out = folder.File("third");
  CHECK(Study(options, {})[0].analysis.biased.size() == 1);
}

TEST_CASE("sample counts", "[study]") {
  StudyOptions options;
  options.confidence = 0.95;
  CHECK(options.Repetitions() == 8);
  options.confidence = 0.99;
  CHECK(options.Repetitions() == 10);
  options.repetitions = 1;
  CHECK(options.Repetitions() == 1);

  SECTION("a budget in seconds gives powers of two and a last count") {
    const TemporaryFolder folder;
    StudyOptions budget = TinyStudy(folder, "out");
    budget.spp.clear();
    budget.budget = 0.05;
    budget.repetitions = 2;
    const auto studies = Study(budget, {});
    for (const StrategyRuns& runs : studies[0].runs.strategies) {
      REQUIRE(runs.counts.size() >= 2);
      CHECK(runs.counts[0] == 1);
      CHECK(runs.counts[1] == 2);
      CHECK(std::is_sorted(runs.counts.begin(), runs.counts.end()));
    }
  }
}

TEST_CASE("the diffuse models are rendered only for the paper's page", "[study]") {
  const TemporaryFolder folder;
  StudyOptions options = TinyStudy(folder, "out");
  options.spp = {1};
  options.repetitions = 1;
  CHECK(Study(options, {})[0].runs.diffuse.empty());
  options.paper = options.resume = true;
  CHECK(Study(options, {})[0].runs.diffuse.size() == 3);
}

TEST_CASE("a study without counts goes on to 64 samples, or to a small error",
          "[study]") {
  const double unknown = std::numeric_limits<double>::infinity();
  CHECK(DefaultLargest({2.9, 0, unknown}) == 64);
  CHECK(DefaultLargest({2.9, 0, 1000}) == 64);
  CHECK(DefaultLargest({2.9, 0, 9}) == 16);
  CHECK(DefaultLargest({100, 0, 9}) == 64);
  CHECK(DefaultLargest({300, 0, unknown}) == 256);
}

TEST_CASE("the verdict mentions the effect of rare bright samples", "[study]") {
  SceneRuns runs;
  SceneAnalysis analysis;
  for (const char* name : {"base", "steady", "wild"}) {
    runs.strategies.push_back({{name, {}}, RunStatus::kOk, "", {16}});
    StrategyAnalysis s;
    LevelAnalysis level;
    level.repetitions = 8;
    level.relmse = {0.1, 0.09, 0.11};
    s.levels.push_back(level);
    s.efficiency = s.efficiency_trimmed = Interval{1, 1, 1};
    s.rank = {1, 3};
    analysis.strategies.push_back(s);
  }
  analysis.strategies[1].efficiency = Interval{2, 1.5, 2.5};
  analysis.strategies[2].efficiency_trimmed = Interval{4, 3.5, 4.5};
  analysis.strategies[2].heavy_tailed = true;
  analysis.ranking = {1, 0, 2};
  analysis.bias_tests = 2;
  CHECK_THAT(
      Verdict(runs, analysis),
      Contains(
          "steady is the most efficient strategy in these renders (2 [1.5, 2.5] "
          "times the efficiency of base), but base and wild are not significantly") &&
          Contains("much of the error of wild") &&
          Contains("Without the worst 1 % of the pixels, wild is the most efficient") &&
          Contains("No other mean image differs"));
  // What the page lists, the verdict says too.
  analysis.strategies[0].tiles.emplace();
  analysis.strategies[0].tiles->failed = {3};
  CHECK_THAT(Verdict(runs, analysis), Contains("Parts of the image differ") &&
                                          Contains("more than noise for base."));
  analysis.strategies[1].rank = {1, 1};
  analysis.strategies[0].rank = analysis.strategies[2].rank = {2, 3};
  CHECK_THAT(Verdict(runs, analysis),
             Contains("steady is the most efficient strategy: 2 [1.5, 2.5] times"));
}

TEST_CASE("lists of strategies", "[study]") {
  StudyOptions options;
  const auto defaults = StudyStrategies(options, {});
  REQUIRE(defaults.size() == 9);
  CHECK(defaults[8].strategy == defaults[7].strategy);  // the scene's own is the default
  Strategy own;
  own.sampler = SampleSequence::kHalton;
  const auto named = StudyStrategies(options, own);
  REQUIRE(named.size() == 9);
  CHECK(named[7].strategy == Strategy{});
  CHECK(named[8].strategy == own);
  options.all_strategies = true;
  const auto all = StudyStrategies(options, {});
  CHECK(all.size() > 20);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(all[i].name == all[j].name);
  }
  CHECK(PaperFigure("paper-uniform") == 2);
  CHECK(PaperFigure("paper-roulette") == 7);
  CHECK(PaperFigure("default") == 0);
}

}  // namespace lanelight
