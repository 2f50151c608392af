// Cache-line aligned storage that vector loads may overrun by one full vector.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace lanelight {

inline constexpr std::size_t kCacheLine = 64;

/// Allocates 64-byte aligned memory with 64 spare bytes at the end, so that a vector
/// load or store that starts at a valid element never leaves the allocation.
template <typename T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <typename U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT(google-explicit-constructor)
  T* allocate(std::size_t n) {
    return static_cast<T*>(
        ::operator new(n * sizeof(T) + kCacheLine, std::align_val_t(kCacheLine)));
  }
  void deallocate(T* p, std::size_t) {
    ::operator delete(p, std::align_val_t(kCacheLine));
  }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) {
    return true;
  }
};

template <typename T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace lanelight
