// Writes compiled values into records.
#pragma once

#include "src/base/core/transform.h"
#include "src/base/core/vec.h"

namespace lanelight {

/// Into a field of a record.
inline void Store(Vec3d v, float out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

/// The rows of an affine map.
inline void Store(const Transform& t, float out[12]) {
  for (int i = 0; i < 12; ++i) out[i] = static_cast<float>(t(i / 4, i % 4));
}

}  // namespace lanelight
