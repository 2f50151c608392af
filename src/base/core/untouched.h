// Vectors whose memory is not cleared.
#pragma once

#include <vector>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Leaves memory as it is: what is never used is never touched.
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

/// Elements that resize() adds have no value until they get one.
template <typename T>
using UntouchedVector = std::vector<T, UntouchedAllocator<T>>;

}  // namespace lanelight
