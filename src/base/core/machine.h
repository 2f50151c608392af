// What differs between processors, and all of it: the names of x86 and ARM, their
// counters and control registers are in machine.h and machine.cc alone
// (tests/base/core/machine_test.cc). x86-64 and 64-bit ARM (AArch64) are known; whatever
// else Highway compiles for renders too, with a clock that costs more.
#pragma once

#include <cstdint>

namespace lanelight {

/// True if TimeStamp() counts: x86 whose counter runs at the same rate in every power
/// state, on all cores. ARM has such a counter too, but std::chrono reads it there
/// without entering the kernel, and it is not finer.
extern const bool kHasTimeStamps;

/// The counter, in a unit of its own; 0 where there is none.
inline std::uint64_t TimeStamp() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();  // of GCC and clang: no long header of intrinsics
#else
  return 0;
#endif
}

#if defined(__x86_64__) || defined(__aarch64__)
/// While it lives, subnormal numbers are zeros in this thread, as operands and as
/// results. For measuring others under their own conditions (Embree's manual asks it of
/// threads that call it): renders run without.
class FlushToZero {
 public:
  FlushToZero();
  ~FlushToZero();
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  std::uint64_t before_;
};
#endif

}  // namespace lanelight
