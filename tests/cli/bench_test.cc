// `lanelight bench` from the outside: tables, files, comparisons and their exit codes.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Contains;
using test::ReadJson;
using Json = nlohmann::json;

ProcessResult Bench(const TempDirectory& directory, std::vector<std::string> flags) {
  std::vector<std::string> arguments = {
      "bench", WriteSphereScene(directory), "--spp", "2", "--threads", "1", "--within",
      "1"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return RunLanelight(arguments);
}

// The measurement with all rates multiplied.
std::string Scaled(const std::string& path, double factor, const std::string& to) {
  Json json = ReadJson(path);
  json["busy"] = Json::array();
  for (Json& row : json["rows"]) {
    for (const char* end : {"value", "low", "high"}) {
      for (const char* per : {"samples_per_second", "samples_per_cpu_second"}) {
        row[per][end] = factor * row[per][end].get<double>();
      }
    }
  }
  return WriteText(to, json.dump());
}

}  // namespace

TEST_CASE("bench prints rates and writes JSON", "[cli]") {
  const TempDirectory directory;
  const ProcessResult r = Bench(
      directory, {"--json", directory / "b.json", "--csv", directory / "b.csv",
                  "--markdown", directory / "b.md", "--html", directory / "b.html"});
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  CHECK_THAT(r.out,
             Contains("Msamples/CPU s") && Contains("machine") && Contains("lanes"));
  CHECK_THAT(r.err, Contains("(1 of 1), ") && Contains(" s left"));
  const Json json = ReadJson(directory / "b.json");
  CHECK(json.at("schema") == 1);
  CHECK(json.at("machine").contains("processor"));
  REQUIRE(json.at("rows").size() == 1);
  const Json& row = json.at("rows")[0];
  CHECK(row.at("samples") == 2 * 32 * 24);
  CHECK(row.at("seconds").size() >= 6);
  CHECK(row.at("samples_per_second").at("value") > 0);
  std::ifstream csv(directory / "b.csv"), markdown(directory / "b.md");
  int lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  CHECK(lines == 2);
  std::string text((std::istreambuf_iterator<char>(markdown)), {});
  CHECK(std::filesystem::file_size(directory / "b.html") > 50'000);
  CHECK(Bench(directory, {"--html", directory / "b.json"}).exit_code == kExitUsage);
  CHECK_THAT(text, Contains("| scene | target |") && Contains("|---|---|---:|"));
}

TEST_CASE("bench reports slower rows, also by its exit code", "[cli]") {
  const TempDirectory directory;
  const std::string path = directory / "b.json";
  REQUIRE(Bench(directory, {"--json", path}).exit_code == kExitGood);
  // On a machine so busy that nothing can be judged, the program says so.
  const auto check = [](const ProcessResult& r, int code, const char* words) {
    INFO(r.out);
    const bool busy = r.out.find("could have been found") != std::string::npos;
    CHECK(r.exit_code == (busy ? kExitNotComparable : code));
    CHECK_THAT(r.out, Contains(busy ? "not comparable" : words));
  };
  const std::string fast = Scaled(path, 1000, directory / "fast.json");
  check(Bench(directory, {"--against", fast}), kExitSlower, "slower: ");
  const std::string slow = Scaled(path, 1e-3, directory / "slow.json");
  check(Bench(directory, {"--against", slow}), kExitGood, "no row is slower");

  Json json = ReadJson(slow);
  json["busy"] = {"the load was 9"};
  const std::string busy = WriteText(directory / "busy.json", json.dump());
  check(Bench(directory, {"--against", busy}), kExitGood, "earlier run: the load was 9");
  const ProcessResult other =
      Bench(directory, {"--against", slow, "--resolution", "8x8"});
  CHECK(other.exit_code == kExitNotComparable);
  CHECK_THAT(other.out, Contains("refused: "));
}

TEST_CASE("bench lists stored results, alone and beside a measured one", "[cli]") {
  const TempDirectory directory, results;
  const ProcessResult built_in = RunLanelight({"bench", "--list"});
  INFO(built_in.err);
  REQUIRE(built_in.exit_code == kExitGood);
  CHECK_THAT(built_in.out, Contains("amd-epyc-2-cores") && Contains("CPU ratio") &&
                               !Contains("this run"));
  CHECK(RunLanelight({"bench", "--list", results.path()}).exit_code == kExitBadInput);
  REQUIRE(Bench(directory, {"--json", results / "mine.json"}).exit_code == kExitGood);
  const ProcessResult mine = RunLanelight({"bench", "--list", results / "mine.json"});
  CHECK_THAT(mine.out, Contains("amd-epyc-2-cores") && Contains("mine"));
  const ProcessResult both = Bench(directory, {"--list", results.path()});
  CHECK(both.exit_code == kExitGood);
  CHECK_THAT(both.out, Contains("1  this run") && Contains("2  mine") &&
                           !Contains("not comparable"));
  const ProcessResult other =
      Bench(directory, {"--resolution", "8x8", "--list", results.path()});
  CHECK_THAT(other.out, Contains("* not comparable"));
}

TEST_CASE("bench refuses a time that is too short for its work", "[cli]") {
  const TempDirectory directory;
  const ProcessResult r = Bench(directory, {"--time", "0.01", "--resolution", "512x512",
                                            "--json", directory / "b.json"});
  CHECK(r.exit_code == kExitUsage);
  CHECK_THAT(r.err,
             Contains("6 renders of each row take about ") && Contains("; use --time "));
  CHECK(r.out.empty());
  CHECK_FALSE(std::filesystem::exists(directory / "b.json"));
  CHECK(Bench(directory, {"--time", "20"}).exit_code == kExitGood);
}

TEST_CASE("bench refuses invalid input", "[cli]") {
  const TempDirectory directory;
  const std::string broken = WriteText(directory / "broken.json", "{\"rows\": 1}");
  const ProcessResult r = Bench(directory, {"--against", broken});
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("broken.json"));
  const std::string other = WriteText(directory / "other.json", "{}");
  CHECK_THAT(Bench(directory, {"--against", other}).err,
             Contains("was not written by `lanelight bench --json`"));
  CHECK(Bench(directory, {"--against", directory / "none"}).exit_code == kExitBadInput);
  CHECK(Bench(directory, {"--within", "0"}).exit_code == kExitUsage);
  CHECK(Bench(directory, {"--simd", "Z80"}).exit_code == kExitUsage);
  CHECK(Bench(directory, {"--all-targets", "--simd", "EMU128"}).exit_code == kExitUsage);
  CHECK(RunLanelight({"bench", "no-such.pbrt"}).exit_code == kExitBadInput);
}

}  // namespace lanelight
