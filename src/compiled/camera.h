// Camera and pixel filter as the kernels read them.
#pragma once

#include "src/core/aligned.h"
#include "src/core/vec.h"
#include "src/scene/description.h"

namespace lanelight {

struct CompiledCamera {
  CameraKind kind = CameraKind::kPerspective;
  // Camera-space direction (perspective) or origin (orthographic) of film position
  // (x, y) in pixels: base + x * dx + y * dy, in camera space, perspective: z = 1.
  Vec3f base, dx, dy;
  float lens_radius = 0, focal_distance = 1;  // scene units
  // Camera to scene: rotation columns (unit or scaled axes) and origin.
  Vec3f right, up, forward, origin;
};

/// Separable filter, sampled by inverting a piecewise-linear CDF per axis. Weight of a
/// sample: sign_x * sign_y * weight (positive filters: 1).
struct CompiledFilter {
  static constexpr int kSize = 64;
  float x_radius = 0.5f, y_radius = 0.5f;
  bool is_box = true;                   // then the tables are unused
  AlignedVector<float> x_cdf, y_cdf;    // kSize + 1 entries each, of |f|
  AlignedVector<float> x_sign, y_sign;  // kSize entries, +-1
  float weight = 1;                     // integral |f| / integral f over both axes
};

}  // namespace lanelight
