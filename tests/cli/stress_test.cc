// `lanelight stress` from the outside.
#include <signal.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;
using Json = nlohmann::json;

Json Parsed(const std::string& path) {
  std::ifstream in(path);
  REQUIRE(in);
  return Json::parse(in);
}

}  // namespace

TEST_CASE("stress --list prints the extreme parameter and the expected property",
          "[cli][stress]") {
  const ProcessResult r = RunLanelight({"stress", "--list"});
  CHECK(r.exit_code == kExitGood);
  CHECK(r.err.empty());
  CHECK_THAT(r.out, Contains("\nunits\n") || Catch::StartsWith("units\n"));
  CHECK_THAT(r.out, Contains("  unit-of-length\n") && Contains("must: "));
  const ProcessResult one = RunLanelight({"stress", "unit-of-*", "--list"});
  CHECK_THAT(one.out, Contains("unit-of-length") && Contains("1 case"));
}

TEST_CASE("stress: an unknown name is reported with the nearest one", "[cli][stress]") {
  const ProcessResult r = RunLanelight({"stress", "unit-of-lenght"});
  CHECK(r.exit_code == kExitUsage);
  CHECK_THAT(r.err, Contains("did you mean \"unit-of-length\"?") && Contains("--list"));
  CHECK(r.out.empty());
  CHECK(RunLanelight({"stress", "--simd", "AVX9000"}).exit_code == kExitUsage);
  CHECK(RunLanelight({"stress", "--seed", "-1"}).exit_code == kExitUsage);
  CHECK(RunLanelight({"stress", "--seed", "1e3"}).exit_code == kExitUsage);
}

TEST_CASE("stress: a case prints its row and writes its files", "[cli][stress]") {
  TempDirectory directory;
  const std::string out = directory / "stress", json = directory / "one.json";
  const ProcessResult r = RunLanelight(
      {"stress", "unit-of-length", "--simd", "all", "--out", out, "--json", json});
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("first failure") && Contains("unit-of-length") &&
                        Contains("The one case is good on " + AvailableTargets()[0]) &&
                        Contains(out + "/report.html"));
  CHECK_THAT(r.err, Contains("stress: 1 of"));
  const Json report = Parsed(out + "/stress.json");
  CHECK(report == Parsed(json));
  CHECK(report.at("settings").at("targets") == AvailableTargets());
  const Json& one = report.at("cases").at(0);
  CHECK(one.at("outcome") == "good");
  CHECK(one.at("points").size() % AvailableTargets().size() == 0);
  CHECK(one.at("points").at(0).at("samples") > 0);
  std::ifstream page(out + "/report.html");
  std::string first;
  std::getline(page, first);
  CHECK(first == "<!doctype html>");
}

TEST_CASE("stress --json - prints only JSON", "[cli][stress]") {
  const ProcessResult r =
      RunLanelight({"stress", "unit-of-length", "--json", "-", "--quiet"});
  CHECK(r.exit_code == kExitGood);
  CHECK(r.err.empty());
  CHECK(Json::parse(r.out).at("kind") == "lanelight-stress");
}

TEST_CASE("stress: unwritable outputs are errors", "[cli][stress]") {
  for (const char* flag : {"--out", "--json"}) {
    const ProcessResult r =
        RunLanelight({"stress", "unit-of-length", flag, "/dev/null/x"});
    CHECK(r.exit_code == kExitBadInput);
    CHECK_THAT(r.err, Contains("/dev/null"));
    CHECK(r.out.empty());  // said before anything is measured
  }
}

TEST_CASE("stress: an interruption keeps finished measurements", "[cli][stress]") {
  TempDirectory directory;
  ProcessOptions interrupt;
  interrupt.trigger = "stress: 1 of";
  interrupt.action = [](int child) { kill(child, SIGINT); };
  const std::string out = directory / "stress";
  const ProcessResult r =
      RunLanelight({"stress", "unit-of-length", "--full", "--out", out}, interrupt);
  CHECK(r.signal == 0);
  CHECK(r.exit_code == kExitInterrupted);
  CHECK_THAT(r.err, Contains("finishing the current point"));
  CHECK_THAT(r.out, Contains("not measured completely"));
  CHECK(Parsed(out + "/stress.json").at("interrupted") == true);
}

}  // namespace lanelight
