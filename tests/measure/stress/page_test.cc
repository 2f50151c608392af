// What a run is told as: a sentence, files, the page.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/base/core/error.h"
#include "src/measure/report/page.h"
#include "src/measure/stress/stress_json.h"
#include "tests/base/image/temporary_folder.h"
#include "tests/measure/stress/synthetic_run.h"

namespace lanelight::stress {

using Json = nlohmann::json;

TEST_CASE("stress: the result is summarised in one sentence", "[stress]") {
  SuiteResult result = SyntheticRun();
  CHECK(
      Sentence(result) ==
      "1 of 7 cases fails on AVX3 and EMU128: wrong-inside; 1 more has points too noisy "
      "to detect an error of 10 %.");
  result.cases.erase(result.cases.begin() + 2, result.cases.begin() + 4);
  CHECK(Sentence(result) == "All 5 cases are good on AVX3 and EMU128.");
  result.cases.resize(1);
  result.options.targets = {"AVX2"};
  CHECK(Sentence(result) == "The one case is good on AVX2.");
  result.cases.clear();
  CHECK(Sentence(result) == "No case was measured.");
}

TEST_CASE("stress: results are replaced atomically", "[stress]") {
  const TemporaryFolder folder;
  const std::string dir = folder.File("a/b");
  WriteResults(SyntheticRun(), dir);
  std::ifstream in(dir + "/stress.json");
  CHECK(Json::parse(in)["cases"].size() == 7);
  CHECK(std::filesystem::file_size(dir + "/report.html") > 50'000);
  CHECK_THROWS_AS(WriteResults(SyntheticRun(), folder.Write("file", "") + "/x"),
                  InputError);
}

TEST_CASE("The synthetic stress page can be written", "[stress][report]") {
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_STRESS");
  const std::string page = ReportPage(PageKind::kStress, ToJson(SyntheticRun()));
  CHECK(page.find("<b>odd") == std::string::npos);
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace lanelight::stress
