// The machine that a program runs on, as far as the system tells: what a throughput means
// nothing without. Whatever is not known is left open; nothing is guessed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lanelight {

// X(type, name): one member each, by this name in JSON, and as machine_NAME in tables.
#define LANELIGHT_MACHINE(X)                                                            \
  X(std::string, processor)      /* its model */                                        \
  X(std::uint64_t, cores)        /* hardware threads that the process may run on */     \
  X(double, quota)               /* as many of them at a time, by its control groups */ \
  X(std::uint64_t, memory_bytes) /* or what its control groups leave of it */           \
  X(double, load)                /* of the minute before it began */

struct MachineInfo {
#define X(type, name) std::optional<type> name;
  LANELIGHT_MACHINE(X)
#undef X
};

/// This one; looked at once. The load is of before the program began: later it is its
/// own.
const MachineInfo& ThisMachine();

/// "AMD EPYC 9B14, 2 cores, 7.8 GiB, load 0.42".
std::string MachineText(const MachineInfo& machine);

/// Cores that the process may use at a time: all of them, or its quota if that is less.
std::optional<double> CoresAtATime(const MachineInfo& machine);
/// The load of the minute before the program began exceeds these cores, so that other
/// programs take part of the time that it measures. False where either is unknown.
bool IsOverloaded(const MachineInfo& machine);

/// Adds it, unless there is one of which MachineText() says the same but for the load: of
/// these two the higher load stays.
void AddMachine(const MachineInfo& machine, std::vector<MachineInfo>& machines);

/// The model in the text of /proc/cpuinfo; ARM has none there, but numbers of who makes
/// it and of what. Where cores are of several models, all of them.
std::optional<std::string> ProcessorIn(std::string_view cpuinfo);

/// The limits that control groups set for a process.
struct GroupLimits {
  std::optional<double> quota;
  std::optional<std::uint64_t> memory_bytes;
};
/// The least that `group` or one of those around it leaves ("/a/b": /a/b, /a, /), as the
/// second version of control groups says in the files below `top`.
GroupLimits LimitsOfGroup(const std::filesystem::path& top, const std::string& group);

}  // namespace lanelight
