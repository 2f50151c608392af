#include "src/base/core/hardware_counters.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace lanelight {
namespace {

int Open(const CounterEvent& event, int leader) {
  perf_event_attr attributes;
  std::memset(&attributes, 0, sizeof(attributes));
  attributes.size = sizeof(attributes);
  attributes.type = event.type;
  attributes.config = event.config;
  attributes.exclude_kernel = 1;  // allowed up to perf_event_paranoid = 2
  attributes.exclude_hv = 1;
  // Counts all the time that the thread runs, or not at all.
  attributes.pinned = leader < 0;
  attributes.read_format = PERF_FORMAT_GROUP;
  return static_cast<int>(
      syscall(SYS_perf_event_open, &attributes, 0, -1, leader, PERF_FLAG_FD_CLOEXEC));
}

std::string PerfEventParanoidText() {
  std::ifstream file("/proc/sys/kernel/perf_event_paranoid");
  int level = 0;
  return file >> level ? fmt::format(" (here it is {})", level) : "";
}

}  // namespace

CounterEvents HardwareEvents() {
  const std::uint64_t l1_read_misses = PERF_COUNT_HW_CACHE_L1D |
                                       PERF_COUNT_HW_CACHE_OP_READ << 8 |
                                       PERF_COUNT_HW_CACHE_RESULT_MISS << 16;
  return {{{PERF_TYPE_HARDWARE, PERF_COUNT_HW_CPU_CYCLES},
           {PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS},
           {PERF_TYPE_HW_CACHE, l1_read_misses},
           {PERF_TYPE_HARDWARE, PERF_COUNT_HW_CACHE_MISSES}}};
}

CounterGroup::CounterGroup(const CounterEvents& events) {
  files_.fill(-1);
  for (std::size_t i = 0; i < files_.size() && (i == 0 || available()); ++i) {
    files_[i] = Open(events[i], files_[0]);
    if (files_[i] < 0 && error_ == 0) error_ = errno;
  }
}

CounterGroup::~CounterGroup() {
  for (int file : files_) {
    if (file >= 0) close(file);
  }
}

bool CounterGroup::Read(CounterValues* values) const {
  // PERF_FORMAT_GROUP: the count, then the values. A pinned group that does not fit into
  // the processor reads as the end of the file.
  std::uint64_t data[1 + kNumCounters] = {};
  if (!available() || read(files_[0], data, sizeof(data)) <= 0) return false;
  const std::uint64_t* next = data + 1;
  for (std::size_t i = 0; i < files_.size(); ++i) {
    (*values)[i] = files_[i] < 0 ? 0 : *next++;
  }
  return true;
}

std::string CountersProblem(int error) {
  std::string reason =
      fmt::format("perf_event_open: {} ({})", strerrorname_np(error), strerror(error));
  switch (error) {
    case EACCES:
    case EPERM:
      return reason + "; needs /proc/sys/kernel/perf_event_paranoid of 2 or less" +
             PerfEventParanoidText() +
             ", or CAP_PERFMON, and a seccomp filter that lets it through";
    case ENOENT:
    case ENODEV:
    case EOPNOTSUPP:
      return reason +
             "; the kernel finds no hardware counters; on a virtual machine, the host "
             "must "
             "provide a virtual PMU";
    case EBUSY:
      return reason +
             "; other programs or the kernel's watchdog "
             "(/proc/sys/kernel/nmi_watchdog) use the processor's counters";
    case ENOSYS:
      return reason + "; needs a kernel with CONFIG_PERF_EVENTS";
    default:
      return reason;
  }
}

}  // namespace lanelight
