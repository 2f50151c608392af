// What is said of a machine is what the system says of it, or that it is not known.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "src/base/core/machine_info.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

constexpr const char* kX86 =
    "processor\t: 0\nvendor_id\t: GenuineIntel\ncpu family\t: 6\nmodel\t\t: 79\n"
    "model name\t: Intel(R) Xeon(R) CPU           @ 2.20GHz\nflags\t\t: fpu vme\n\n"
    "processor\t: 1\nmodel name\t: Intel(R) Xeon(R) CPU           @ 2.20GHz\n\n";

// Two kinds of cores; the last line of a Raspberry Pi describes the whole.
constexpr const char* kArm =
    "processor\t: 0\nBogoMIPS\t: 48.00\nCPU implementer\t: 0x41\n"
    "CPU architecture: 8\nCPU variant\t: 0x0\nCPU part\t: 0xd05\nCPU revision\t: 0\n\n"
    "processor\t: 1\nCPU implementer\t: 0x41\nCPU part\t: 0xd0b\n\n"
    "processor\t: 2\nCPU implementer\t: 0x41\nCPU part\t: 0xd0b\n\n"
    "Model\t\t: Some board\n";

MachineInfo Small() {
  MachineInfo machine;
  machine.processor = "AMD EPYC";
  machine.cores = 4;
  machine.memory_bytes = std::uint64_t{15} << 29;
  machine.load = 0.25;
  return machine;
}

}  // namespace

TEST_CASE("the processor's name is read from /proc/cpuinfo", "[machine]") {
  CHECK(ProcessorIn(kX86) == "Intel(R) Xeon(R) CPU @ 2.20GHz");
  CHECK(ProcessorIn(kArm) ==
        "ARM implementer 0x41 part 0xd05 and ARM implementer 0x41 part 0xd0b");
  CHECK(ProcessorIn("") == std::nullopt);
  CHECK(ProcessorIn("processor\t: 0\nmodel name\t:\nmodel name\nCPU part\t: 0x1\n") ==
        std::nullopt);
}

TEST_CASE("the tightest control group limits a process", "[machine]") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder.File(name);
    std::filesystem::create_directories(path.parent_path());
    folder.Write(name, text);
  };
  const std::string top = folder.File("");
  CHECK(LimitsOfGroup(top, "/a/b").quota == std::nullopt);
  CHECK(LimitsOfGroup(top, "/a/b").memory_bytes == std::nullopt);
  write("a/cpu.max", "150000 100000\n");
  write("a/memory.max", "max\n");
  write("a/b/cpu.max", "max 100000\n");
  write("a/b/memory.max", "8000\n");
  write("a/b/c/cpu.max", "400000 100000\n");
  write("a/b/c/memory.max", "9000\n");
  for (const char* group : {"/a/b", "/a/b/c", "/a/b/c/not there"}) {
    CHECK(LimitsOfGroup(top, group).quota == 1.5);
    CHECK(LimitsOfGroup(top, group).memory_bytes == 8000);
  }
  CHECK(LimitsOfGroup(top, "/a").memory_bytes == std::nullopt);
  CHECK(LimitsOfGroup(top, "").quota == std::nullopt);
  CHECK(LimitsOfGroup(folder.File("a"), "").quota == 1.5);
}

TEST_CASE("a machine is described in one line", "[machine]") {
  MachineInfo machine = Small();
  CHECK(MachineText(machine) == "AMD EPYC, 4 cores, 7.5 GiB, load 0.25");
  machine.quota = 1.5;
  CHECK(MachineText(machine) == "AMD EPYC, 4 cores (1.5 at a time), 7.5 GiB, load 0.25");
  machine.quota = 8;
  machine.cores = 1;
  CHECK(MachineText(machine) == "AMD EPYC, 1 core, 7.5 GiB, load 0.25");
  CHECK(MachineText({}) ==
        "unknown processor, cores unknown, memory unknown, load unknown");
}

TEST_CASE("records of the same machine merge, with the highest load", "[machine]") {
  std::vector<MachineInfo> machines;
  MachineInfo other = Small(), idle = Small(), busy = Small(), unmeasured = Small();
  other.cores = 8;
  idle.load = 0.01;
  busy.load = 3;
  unmeasured.load.reset();
  for (const MachineInfo& m : {unmeasured, Small(), other, busy, idle, unmeasured}) {
    AddMachine(m, machines);
  }
  REQUIRE(machines.size() == 2);
  CHECK(machines[0].cores == 4);
  CHECK(machines[0].load == 3);
  CHECK(machines[1].cores == 8);
}

TEST_CASE("this machine reports cores, memory and load", "[machine]") {
  const MachineInfo& machine = ThisMachine();
  REQUIRE(machine.cores);
  CHECK(*machine.cores >= 1);
  REQUIRE(machine.memory_bytes);
  CHECK(*machine.memory_bytes > std::uint64_t{1} << 26);
  double load = 0;
  CHECK(machine.load.has_value() == (getloadavg(&load, 1) == 1));
  if (machine.load) CHECK(*machine.load >= 0);
  CHECK(&machine == &ThisMachine());
}

}  // namespace lanelight
