#include "src/base/core/machine_info.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <sched.h>

namespace lanelight {
namespace {

std::optional<double> LoadNow() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? std::optional(load) : std::nullopt;
}

// Read before main(), since the program itself adds load.
const std::optional<double> load_at_start = LoadNow();

std::string FileText(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Reduces white space to single spaces between words.
std::string CollapseSpaces(std::string_view text) {
  std::istringstream words{std::string(text)};
  std::string out;
  for (std::string word; words >> word;) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::optional<std::uint64_t> CoresAllowed() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof(set), &set) == 0) {
    return static_cast<std::uint64_t>(CPU_COUNT(&set));
  }
  // The machine has more cores than the set holds.
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  return cores > 0 ? std::optional(static_cast<std::uint64_t>(cores)) : std::nullopt;
}

std::optional<std::uint64_t> MemoryOfMachine() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return std::nullopt;
  return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
}

template <class T>
void SetMin(std::optional<T>& minimum, const std::optional<T>& other) {
  if (other) minimum = minimum ? std::min(*minimum, *other) : *other;
}

// Returns the group of version 2, whose line is "0::/system.slice/x"; "" without one.
std::string OwnGroup() {
  std::istringstream lines(FileText("/proc/self/cgroup"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("0::/")) return line.substr(3);
  }
  return "";
}

// Without a limit, files contain "max", which is not read as a number.
GroupLimits LimitsIn(const std::filesystem::path& folder) {
  GroupLimits limits;
  std::istringstream memory(FileText(folder / "memory.max"));
  std::istringstream time(FileText(folder / "cpu.max"));
  if (std::uint64_t bytes = 0; memory >> bytes && bytes > 0) limits.memory_bytes = bytes;
  double used = 0, period = 0;
  if (time >> used >> period && used > 0 && period > 0) limits.quota = used / period;
  return limits;
}

MachineInfo ReadMachineInfo() {
  const GroupLimits limits = LimitsOfGroup("/sys/fs/cgroup", OwnGroup());
  MachineInfo machine;
  machine.processor = ProcessorIn(FileText("/proc/cpuinfo"));
  machine.cores = CoresAllowed();
  machine.quota = limits.quota;
  machine.memory_bytes = MemoryOfMachine();
  SetMin(machine.memory_bytes, limits.memory_bytes);
  machine.load = load_at_start;
  return machine;
}

std::string CoresText(const MachineInfo& machine) {
  if (!machine.cores) return "cores unknown";
  std::string text =
      fmt::format("{} core{}", *machine.cores, *machine.cores == 1 ? "" : "s");
  if (!machine.quota || *machine.quota >= double(*machine.cores)) return text;
  return text + fmt::format(" ({:.3g} at a time)", *machine.quota);
}

std::string TextWithoutLoad(const MachineInfo& machine) {
  constexpr double kGiB = 1 << 30;
  return machine.processor.value_or("unknown processor") + ", " + CoresText(machine) +
         ", " +
         (machine.memory_bytes ? fmt::format("{:.1f} GiB", *machine.memory_bytes / kGiB)
                               : "memory unknown");
}

}  // namespace

const MachineInfo& ThisMachine() {
  static const MachineInfo machine = ReadMachineInfo();
  return machine;
}

std::string MachineText(const MachineInfo& machine) {
  return TextWithoutLoad(machine) + ", load " +
         (machine.load ? fmt::format("{:.2f}", *machine.load) : "unknown");
}

std::optional<double> CoresAtATime(const MachineInfo& machine) {
  if (!machine.cores) return machine.quota;
  return std::min(double(*machine.cores), machine.quota.value_or(double(*machine.cores)));
}

bool IsOverloaded(const MachineInfo& machine) {
  const std::optional<double> cores = CoresAtATime(machine);
  return machine.load && cores && *machine.load > *cores;
}

std::vector<std::string> BusyReasons(const MachineInfo& machine, double waiting) {
  std::vector<std::string> reasons;
  if (IsOverloaded(machine)) {
    reasons.push_back(
        fmt::format("the load before the start, {:.2f}, exceeds the {:.3g} "
                    "cores of the machine",
                    *machine.load, *CoresAtATime(machine)));
  }
  if (waiting > kMaxWaiting) {
    reasons.push_back(fmt::format(
        "threads waited for a processor up to {:.0f} % of the time", 100 * waiting));
  }
  return reasons;
}

void AddMachine(const MachineInfo& machine, std::vector<MachineInfo>& machines) {
  const auto same = [text = TextWithoutLoad(machine)](const MachineInfo& other) {
    return TextWithoutLoad(other) == text;
  };
  const auto found = std::find_if(machines.begin(), machines.end(), same);
  if (found == machines.end()) {
    machines.push_back(machine);
  } else if (machine.load) {
    found->load = std::max(found->load.value_or(*machine.load), *machine.load);
  }
}

std::optional<std::string> ProcessorIn(std::string_view cpuinfo) {
  std::vector<std::string> models;
  const auto add = [&](const std::string& model) {
    if (std::find(models.begin(), models.end(), model) == models.end()) {
      models.push_back(model);
    }
  };
  std::string implementer;
  std::istringstream lines{std::string(cpuinfo)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = std::min(line.find(':'), line.size());
    const std::string name = CollapseSpaces(line.substr(0, colon));
    const std::string value =
        CollapseSpaces(line.substr(std::min(colon + 1, line.size())));
    if (value.empty()) continue;
    if (name == "model name") add(value);
    if (name == "CPU implementer") implementer = value;
    if (name == "CPU part" && !implementer.empty()) {
      add("ARM implementer " + implementer + " part " + value);
    }
  }
  if (models.empty()) return std::nullopt;
  return fmt::format("{}", fmt::join(models, " and "));
}

GroupLimits LimitsOfGroup(const std::filesystem::path& top, const std::string& group) {
  GroupLimits minimum = LimitsIn(top);
  std::filesystem::path folder = top;
  for (const auto& part : std::filesystem::path(group).relative_path()) {
    folder /= part;
    const GroupLimits limits = LimitsIn(folder);
    SetMin(minimum.quota, limits.quota);
    SetMin(minimum.memory_bytes, limits.memory_bytes);
  }
  return minimum;
}

double RunDelaySeconds() {
  double ns = 0;
  std::error_code error;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", error)) {
    std::istringstream times(FileText(task.path() / "schedstat"));
    double running = 0, waiting = 0;
    if (times >> running >> waiting) ns += waiting;
  }
  return 1e-9 * ns;
}

}  // namespace lanelight
