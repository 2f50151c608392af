// Textures as the kernels read them (filled by CompileScene, see texture_table.cc).
#pragma once

#include <cstdint>
#include <vector>

#include "src/core/aligned.h"

namespace lanelight {

struct TextureTable {
  std::size_t size() const { return 0; }
};

}  // namespace lanelight
