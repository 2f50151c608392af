// The memory of one wavefront: live columns and queues, allocated once per thread and
// reused by every task.
#pragma once

#include <cstddef>
#include <memory>

#include "src/core/aligned.h"
#include "src/wavefront/plan.h"
#include "src/wavefront/wave.h"

namespace lanelight {

class Wavefront {
 public:
  Wavefront(const CompiledScene& scene, const Plan& plan, const RunParameters& run);

  Wave& wave() { return wave_; }
  /// Bytes of columns and queues.
  std::size_t bytes() const { return memory_.size() * sizeof(std::uint32_t); }
  /// Empties every queue and frees every slot.
  void Reset();

 private:
  AlignedVector<std::uint32_t> memory_;
  Wave wave_;
};

}  // namespace lanelight
