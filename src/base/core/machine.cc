#include "src/base/core/machine.h"

#if defined(__x86_64__)
#include <cpuid.h>
#include <xmmintrin.h>
#endif

namespace lanelight {
namespace {

// Leaf 0x80000007, bit 8 of edx: "invariant TSC" (Intel and AMD manuals).
bool HasInvariantTimeStamps() {
#if defined(__x86_64__)
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(0x80000007u, &a, &b, &c, &d) != 0 && (d & (1u << 8)) != 0;
#else
  return false;
#endif
}

// The control register of subnormal numbers, and its bits.
#if defined(__x86_64__)
constexpr std::uint64_t kFlushBits = _MM_FLUSH_ZERO_ON | 0x40;  // and their use, "DAZ"
std::uint64_t ControlRegister() { return _mm_getcsr(); }
void SetControlRegister(std::uint64_t bits) { _mm_setcsr(static_cast<unsigned>(bits)); }
#elif defined(__aarch64__)
constexpr std::uint64_t kFlushBits = 1u << 24;  // FZ of FPCR: both (Arm ARM, C5.2)
std::uint64_t ControlRegister() {
  std::uint64_t bits = 0;
  asm volatile("mrs %0, fpcr" : "=r"(bits));
  return bits;
}
void SetControlRegister(std::uint64_t bits) {
  asm volatile("msr fpcr, %0" : : "r"(bits));
}
#endif

}  // namespace

const bool kHasTimeStamps = HasInvariantTimeStamps();

#if defined(__x86_64__) || defined(__aarch64__)
FlushToZero::FlushToZero() : before_(ControlRegister()) {
  SetControlRegister(before_ | kFlushBits);
}
FlushToZero::~FlushToZero() { SetControlRegister(before_); }
#endif

}  // namespace lanelight
