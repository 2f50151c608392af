// `lanelight render` reports control variates.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;

struct Reported {
  ProcessResult process;
  nlohmann::json control;
};

Reported Render(const TempDirectory& directory, const std::string& strategy) {
  const std::string scene = WriteSphereScene(directory), json = directory / "r.json";
  Reported out;
  out.process = RunLanelight({"render", scene, "-o", directory / "r.exr", "--json", json,
                              "--png", "--spp", "16", "-v", "--strategy", strategy});
  if (out.process.exit_code == kExitGood) {
    std::ifstream in(json);
    out.control = nlohmann::json::parse(in).at("control");
  }
  return out;
}

}  // namespace

TEST_CASE("the report states the effect of a control variate", "[cli]") {
  const TempDirectory directory;
  const Reported none = Render(directory, "control=none");
  REQUIRE(none.process.exit_code == kExitGood);
  CHECK(none.control.is_null());
  CHECK_THAT(none.process.out, !Contains("correlation"));

  const Reported fitted = Render(directory, "control=regression,points=independent");
  INFO(fitted.process.err);
  REQUIRE(fitted.process.exit_code == kExitGood);
  CHECK(fitted.control.at("coefficient") == 1);
  CHECK(fitted.control.at("paper_coefficient") == -1);
  CHECK(fitted.control.at("correlation").is_number());
  CHECK_THAT(fitted.process.out, Contains("regression") &&
                                     Contains("correlation reached") &&
                                     Contains("all valid"));
}

}  // namespace lanelight
