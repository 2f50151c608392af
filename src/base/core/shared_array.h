// Immutable shared arrays.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Elements that are only read. Copies share them; the last one frees their memory.
template <typename T>
class SharedArray {
 public:
  SharedArray() = default;
  /// Takes what a vector holds.
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

}  // namespace lanelight
