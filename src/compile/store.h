// What compiling writes into records.
#pragma once

#include "src/core/vec.h"

namespace lanelight {

/// Into a field of a record.
inline void Store(Vec3d v, float out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

}  // namespace lanelight
