// Cut-outs as the kernels read them.
#pragma once

#include <cstdint>

#include "src/base/core/aligned.h"

namespace lanelight {

/// Per primitive, only with kAlpha: texture of the alpha cut-out or -1, and constant.
struct AlphaTable {
  AlignedVector<std::int32_t> texture;
  AlignedVector<float> constant;
};

}  // namespace lanelight
