// Code for particular processors, x86-64 and 64-bit ARM (AArch64); no other file has any
// (tests/base/core/machine_test.cc). Other processors that Highway compiles for render
// too, with a slower clock.
#pragma once

#include <cstdint>

namespace lanelight {

/// True if TimeStamp() counts: on x86 whose counter runs at the same rate in every power
/// state, on all cores. On ARM, std::chrono reads such a counter without the kernel.
extern const bool kHasTimeStamps;

/// Returns the counter, in its own unit; 0 if there is none.
inline std::uint64_t TimeStamp() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();  // of GCC and clang: no long header of intrinsics
#else
  return 0;
#endif
}

#if defined(__x86_64__) || defined(__aarch64__)
/// Makes subnormal numbers zero in this thread while it lives, as Embree's manual asks
/// for threads that call it. Renders run without.
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
