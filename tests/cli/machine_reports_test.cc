// Every report for scripts names the machine: a throughput means nothing without.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "src/cli/exit_codes.h"
#include "src/render/job/machine_json.h"
#include "tests/cli/process.h"

namespace lanelight {
namespace {

using Catch::Contains;
using Json = nlohmann::json;

// The load is that of when a process began, hence another one.
Json WithoutLoad(Json machine) {
  machine.erase("load");
  machine.erase("text");
  return machine;
}

}  // namespace

TEST_CASE("reports name the machine", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), image = directory / "out.exr";
  const Json here = ToJson(ThisMachine());
  const std::vector<std::string> commands[] = {
      {"info", "--json"},
      {"plan", scene, "--json"},
      {"render", scene, "-o", image, "--spp", "2", "--json", "-"},
      {"compare", image, image, "--json"},
      {"profile", scene, "--spp", "1", "--json", "-"}};
  for (const auto& command : commands) {
    const ProcessResult r = RunLanelight(command);
    INFO(command[0] << ": " << r.err);
    REQUIRE(r.exit_code == kExitGood);
    const Json machine = Json::parse(r.out).at("machine");
    CHECK(WithoutLoad(machine) == WithoutLoad(here));
    CHECK(machine.at("load").is_null() == here.at("load").is_null());
    CHECK(machine.at("text") == MachineText(MachineFromJson(machine)));
  }
}

TEST_CASE("printed texts and pages name the machine", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory), image = directory / "out.exr";
  const std::string text = MachineText(ThisMachine());
  const std::string line = text.substr(0, text.rfind("load ") + 5);
  const std::vector<std::string> commands[] = {
      {"info"},
      {"render", scene, "-o", image, "--spp", "2", "-v"},
      {"profile", scene, "--spp", "1", "-v"}};
  for (const auto& command : commands) {
    CHECK_THAT(RunLanelight(command).out, Contains(line));
  }
}

}  // namespace lanelight
