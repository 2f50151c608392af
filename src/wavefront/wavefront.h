// The memory of one wavefront: live columns and queues, allocated once per thread and
// reused by every task.
#pragma once

#include <cstddef>
#include <vector>

#include "src/core/aligned.h"
#include "src/wavefront/plan.h"
#include "src/wavefront/wave.h"

namespace lanelight {

/// Leaves memory as it is: the room for copies of paths that split is mostly never
/// touched, and need not be cleared.
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

/// The constants of a render that scene, plan and size of the groups decide; without
/// seed, planned samples and tables.
RunParameters MakeRunParameters(const CompiledScene& scene, const Plan& plan,
                                std::uint32_t group_size);

class Wavefront {
 public:
  Wavefront(const CompiledScene& scene, const Plan& plan, const RunParameters& run);

  Wave& wave() { return wave_; }
  /// Bytes of columns and queues.
  std::size_t bytes() const { return memory_.size() * sizeof(std::uint32_t); }
  /// Empties every queue and frees every slot.
  void Reset();

 private:
  std::vector<std::uint32_t, UntouchedAllocator<std::uint32_t>> memory_;
  Wave wave_;
};

}  // namespace lanelight
