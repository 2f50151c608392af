// Machines in reports and tables.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "src/base/stat/values.h"
#include "src/render/job/machine_json.h"

namespace lanelight {

using Json = nlohmann::json;

TEST_CASE("a machine's JSON has all members, unknown ones as null", "[machine]") {
  MachineInfo machine;
  machine.processor = "a \"b\", c";
  machine.memory_bytes = 123456789012;
  machine.load = 0.5;
  const Json json = Json::parse(ToJson(machine).dump());
  CHECK(json == Json{{"text", MachineText(machine)},
                     {"processor", "a \"b\", c"},
                     {"cores", nullptr},
                     {"quota", nullptr},
                     {"memory_bytes", 123456789012},
                     {"load", 0.5}});
  CHECK(ToJson(MachineFromJson(json)) == json);
  CHECK(ToJson(MachineFromJson(nullptr)) == ToJson(MachineInfo{}));
  CHECK(ToJson(MachineFromJson(Json::object())) == ToJson(MachineInfo{}));
  CHECK(ToJson(std::vector{machine, MachineInfo{}}).size() == 2);
}

TEST_CASE("a machine's columns have its values", "[machine]") {
  MachineInfo machine;
  machine.processor = "a \"b\", c";
  machine.cores = 3;
  machine.quota = 1.5;
  CHECK(MachineCsvHeader() ==
        "machine_processor,machine_cores,machine_quota,machine_memory_bytes,"
        "machine_load");
  CHECK(MachineCsvRow(machine) == "\"a \"\"b\"\", c\",3,1.5,,");
  CHECK(MachineCsvRow({}) == ",,,,");
  CHECK(CsvField("plain") == "plain");
  CHECK(CsvField("two\nlines") == "\"two\nlines\"");
}

}  // namespace lanelight
