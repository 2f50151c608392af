// How large a pixel is where a ray meets a surface, for filtered textures and bump maps.
#pragma once

#include "src/base/core/vec.h"

namespace lanelight {

/// The data of pixel footprints. A footprint is that of the camera at any point, seen
/// directly or not, as in pbrt-v4's Camera::Approximate_dp_dxy: a surface behind a mirror
/// is filtered as if seen from the camera.
///
/// In front of the camera (the cosine to `forward` is at least `min_cosine`) neighbouring
/// pixels are displaced by step_x, step_y at depth 1 (perspective), or anywhere
/// (orthographic). Elsewhere their directions differ by angle_x, angle_y, the smallest
/// such difference on the film.
///
/// All of it is scaled by max(1/8, 1/sqrt(n)), n the `pixelsamples` of the scene's
/// `Sampler`: many samples per pixel filter what one lookup leaves out (pbrt-v4). The
/// number in the file counts, and not how many are rendered: renders go on, and their
/// samples must all be of the same image.
struct PixelFootprint {
  Vec3f eye, forward;              // scene space; forward is a unit vector
  Vec3f step_x, step_y;            // one pixel, scene space
  Vec3f axis_x, axis_y;            // unit vectors along them
  float angle_x = 0, angle_y = 0;  // radians
  float min_cosine = 2;            // 2: no point is in front
  bool parallel = false;           // orthographic
  float scale = 1;                 // of all steps and angles, as above
};

}  // namespace lanelight
