// Cache-line aligned storage that vector loads may overrun by one full vector.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
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

/// A constant array. Copies share the memory; the last one frees it.
template <typename T>
class SharedArray {
 public:
  SharedArray() = default;
  SharedArray(AlignedVector<T> values) {  // NOLINT(google-explicit-constructor)
    const auto own = std::make_shared<const AlignedVector<T>>(std::move(values));
    data_ = own->data();
    size_ = own->size();
    owner_ = own;
  }

  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  const T* data_ = nullptr;
  std::size_t size_ = 0;
  std::shared_ptr<const void> owner_;
};

/// Does not clear memory, so that unused elements are never touched.
template <typename T>
struct UntouchedAllocator : AlignedAllocator<T> {
  template <typename U>
  struct rebind {
    using other = UntouchedAllocator<U>;
  };
  template <typename U>
  void construct(U*) {}
  template <typename U>
  void construct(U* p, const U& value) {
    *p = value;
  }
};

/// A vector in which resize() leaves new elements without a value.
template <typename T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

/// Asks the system to back [data, data + bytes) with large pages where it can, before it
/// is touched. Nothing happens where it cannot.
void AdviseHugePages(void* data, std::size_t bytes);

/// Resizes an empty vector, in large pages.
template <class T>
void ResizeInHugePages(std::vector<T>& values, std::size_t size) {
  values.reserve(size);
  AdviseHugePages(values.data(), size * sizeof(T));
  values.resize(size);
}

}  // namespace lanelight
