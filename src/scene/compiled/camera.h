// Camera, pixel footprint, g-buffer space and pixel filter as the kernels read them.
#pragma once

#include <cstdint>

#include "src/base/core/aligned.h"
#include "src/base/core/motion_record.h"
#include "src/base/core/vec.h"
#include "src/vocabulary/path/scene_kinds.h"

namespace lanelight {

/// Surface of a lens system, or the aperture stop (radius 0). Lengths are in millimetres
/// along the axis from the film at 0 towards the scene.
struct LensSurface {
  float z;          // where it meets the axis
  float radius;     // its centre lies at z + radius
  float eta_ratio;  // of the indices of refraction: towards the film / towards the scene
  float aperture;   // half the diameter
};

/// A lens system (Kolb, Mitchell and Hanrahan 1995). For a film point at distance r along
/// the x axis, rays leave through a rectangle in the plane of the rear surface. It bounds
/// the exit pupil of ring floor(r * rings_per_mm).
struct LensSystem {
  struct Pupil {
    float x0, x1, y0, y1;  // x1 <= x0: no light comes through
  };
  AlignedVector<LensSurface> surfaces;  // from the film on
  AlignedVector<Pupil> pupils;
  float rings_per_mm = 0;
  float rear = 0;                  // z of the plane
  float scene_from_mm = 1;         // scene lengths per millimetre
  std::int32_t aperture_size = 0;  // of the square picture of the aperture; 0: a circle
  AlignedVector<float> aperture;   // transmitted share, row by row
};

struct CompiledCamera {
  CameraKind kind = CameraKind::kPerspective;
  SphericalMapping mapping = SphericalMapping::kEqualArea;
  // Camera-space direction (perspective) or origin (orthographic) of film position
  // (x, y) in pixels: base + x * dx + y * dy, in camera space, perspective: z = 1.
  // Spherical: the point of the map's square instead. Realistic: the point of the film,
  // in millimetres.
  Vec3f base, dx, dy;
  float lens_radius = 0, focal_distance = 1;  // scene units
  LensSystem lenses;                          // realistic
  // Camera to scene: rotation columns (unit or scaled axes) and origin. Of one that moves
  // where the shutter opens; `motion` takes the scene as it is seen from there to the
  // scene as it is seen later.
  Vec3f right, up, forward, origin;
  bool moves = false;
  MotionRecord motion = {};
  // Time of a path, from 0 to 1, for a number u from 0 to 1: first + u * rate, no less
  // than 0 and no more than 1.
  float time_first = 0, time_rate = 1;
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

/// Scene space to camera or world space, in its own units: a point p lies at
/// (x . (p - from), y . (p - from), z . (p - from)) + to. A normal n has the direction
/// (normal_x . n, normal_y . n, normal_z . n).
struct GbufferSpace {
  Vec3f from, to;
  Vec3f x, y, z;
  Vec3f normal_x, normal_y, normal_z;
  bool of_camera = false;  // else of the world
};

}  // namespace lanelight
