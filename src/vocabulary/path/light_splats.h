// What light subpaths of a task bring to the film (light-paths=splats,
// kernels/light_paths/).
#pragma once

#include <cstdint>

#include "src/vocabulary/path/block.h"

namespace lanelight {

/// Vertices of a light subpath that connect to the camera; longer ones end.
inline constexpr std::uint32_t kMaxLightVertices = 8;
/// Column lp_vertex: no light subpath can have found this path.
inline constexpr std::uint32_t kNotFromLight = 0xffu;
/// The kinds of materials, and phase functions, whose vertices connect to the camera.
inline constexpr std::uint32_t kSplattingKinds =
    kEvenSidedKinds | kGlossyKinds | KindBits(kInMedium);

/// Light that reaches the camera through one point of the film, by light subpath and
/// vertex: entry `path * kMaxLightVertices + number - 1`.
struct LightSplats {
  /// Light subpaths of all pixels together per camera sample of one pixel.
  float paths_per_sample = 0;
  /// Film positions that some pixel's filter reaches.
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::uint32_t* present = nullptr;  // 1: the vertex is visible to the camera
  float* x = nullptr;                // film position in pixels
  float* y = nullptr;
  float* light[3] = {};  // radiance times pixels^2 per subpath, before the pixel filter
  /// A training pass stores here where each subpath has started (StoreStart,
  /// kernels/light_paths/emit.cc).
  std::uint32_t* starts = nullptr;
  float* share = nullptr;  // MIS weight of camera paths there: 1 less that of the subpath
};

}  // namespace lanelight
