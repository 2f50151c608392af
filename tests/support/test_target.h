// The SIMD target that fixtures of tests run kernels on. The product has no such thing:
// it hands targets on.
#pragma once

#include <string>

#include "kernels/simd/target.h"

namespace lanelight {

/// That of the last ForceTarget; at first the best.
inline SimdTarget& TestTarget() {
  static SimdTarget target;
  return target;
}
/// From here on fixtures run kernels of this target; empty: of the best.
inline void ForceTarget(const std::string& name) { TestTarget() = SimdTarget(name); }

}  // namespace lanelight
