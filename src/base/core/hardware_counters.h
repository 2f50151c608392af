// Counters of the processor for the calling thread, where the kernel gives them out
// (Linux, perf_event_open).
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace lanelight {

/// What is counted, in the order of CounterValues. User mode only.
enum class Counter : int { kCycles, kInstructions, kL1Misses, kLlcMisses, kCount };
inline constexpr int kNumCounters = static_cast<int>(Counter::kCount);

/// Counts since an arbitrary moment; events that this machine lacks stay 0.
using CounterValues = std::array<std::uint64_t, kNumCounters>;

/// Kinds of events as perf_event_attr has them.
struct CounterEvent {
  std::uint32_t type = 0;
  std::uint64_t config = 0;
};
using CounterEvents = std::array<CounterEvent, kNumCounters>;
/// Cycles, instructions, misses of loads in the first level, misses in the last level.
CounterEvents HardwareEvents();

/// One group of counters. They count the thread that constructs the object, and only it
/// may read them.
class CounterGroup {
 public:
  /// Opens as many of `events` as the kernel gives; the first is required.
  explicit CounterGroup(const CounterEvents& events);
  ~CounterGroup();
  CounterGroup(const CounterGroup&) = delete;
  CounterGroup& operator=(const CounterGroup&) = delete;

  bool available() const { return files_[0] >= 0; }
  bool Has(Counter counter) const { return files_[static_cast<int>(counter)] >= 0; }
  /// errno of the first event that could not be opened; 0 if all could.
  int error() const { return error_; }
  /// The counts now. False if they could not be read, or other programs have taken the
  /// processor's counters. About 0.5 us.
  bool Read(CounterValues* values) const;

 private:
  std::array<int, kNumCounters> files_;
  int error_ = 0;
};

/// Why counters are missing, and what would bring them; `error` as CounterGroup has it.
std::string CountersProblem(int error);

}  // namespace lanelight
