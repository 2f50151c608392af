// The machine that the program runs on. Unknown values stay empty.
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

/// Returns this machine. The load is that before the program began.
const MachineInfo& ThisMachine();

/// "AMD EPYC 9B14, 2 cores, 7.8 GiB, load 0.42".
std::string MachineText(const MachineInfo& machine);

/// Cores that the process may use at a time: all of them, or its quota if that is less.
std::optional<double> CoresAtATime(const MachineInfo& machine);
/// The load of the minute before the program began exceeds these cores, so that other
/// programs take part of the time that it measures. False where either is unknown.
bool IsOverloaded(const MachineInfo& machine);

/// Returns reasons why times measured here depend on other programs: the machine is
/// overloaded, or threads waited for a processor for this fraction of the time, more than
/// kMaxWaiting. Empty if the machine was quiet.
std::vector<std::string> BusyReasons(const MachineInfo& machine, double waiting);
inline constexpr double kMaxWaiting = 0.1;

/// Other programs can add this fraction to the processor time of a render, and to that of
/// one of its stages, since they use the same caches and memory (measured:
/// docs/bench.md).
inline constexpr double kBusySlowdown = 0.15, kBusyStageSlowdown = 0.5;
/// Comparisons of times measured on a busy machine have no verdict if they could not find
/// a change by this fraction.
inline constexpr double kMaxDetectable = 0.3;

/// Returns the seconds that threads of this process, also those without a task, have
/// waited for a processor (Linux; otherwise 0).
double RunDelaySeconds();

/// Adds the machine, unless the list has one that differs in its load alone: that one
/// then gets the higher load.
void AddMachine(const MachineInfo& machine, std::vector<MachineInfo>& machines);

/// Returns the models of the cores in the text of /proc/cpuinfo; on ARM, numbers of the
/// implementer and part.
std::optional<std::string> ProcessorIn(std::string_view cpuinfo);

/// Limits that control groups set for a process.
struct GroupLimits {
  std::optional<double> quota;
  std::optional<std::uint64_t> memory_bytes;
};
/// Returns the lowest limits of `group` and its parents ("/a/b": /a/b, /a, /) in the
/// files of control groups (version 2) below `top`.
GroupLimits LimitsOfGroup(const std::filesystem::path& top, const std::string& group);

}  // namespace lanelight
