#include "bench/intersect/counted_new.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocated{0}, peak{0};

void* Count(void* p) {
  if (!p) throw std::bad_alloc();
  const std::size_t bytes = malloc_usable_size(p);
  const std::size_t now = allocated.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  std::size_t before = peak.load(std::memory_order_relaxed);
  while (now > before &&
         !peak.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
  }
  return p;
}

void Release(void* p) {
  if (p) allocated.fetch_sub(malloc_usable_size(p), std::memory_order_relaxed);
  std::free(p);
}

}  // namespace

// The other forms of the standard library come down to these four.
void* operator new(std::size_t size) { return Count(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t align) {
  const auto a = static_cast<std::size_t>(align);
  return Count(std::aligned_alloc(a, (size + a - 1) / a * a));
}
void operator delete(void* p) noexcept { Release(p); }
void operator delete(void* p, std::align_val_t) noexcept { Release(p); }
void operator delete(void* p, std::size_t) noexcept { Release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { Release(p); }

namespace lanelight::bench {

std::size_t AllocatedBytes() { return allocated.load(std::memory_order_relaxed); }
std::size_t PeakBytes() { return peak.load(std::memory_order_relaxed); }
void ResetPeak() { peak.store(allocated.load()); }

}  // namespace lanelight::bench
