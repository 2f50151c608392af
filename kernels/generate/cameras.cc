// Cameras with a plane film. Perspective: rays from one point through a film at depth 1.
// Orthographic: parallel rays; each film point has its own lens, so that the plane of
// focus is sharp everywhere. Spherical: all directions from one point.
#include "kernels/simd/each_target-inl.h"

#include "kernels/generate/camera-inl.h"
#include "kernels/simd/math-inl.h"
#include "kernels/warp/sphere-inl.h"

LANELIGHT_BEGIN_KERNELS

struct Perspective {
  static HWY_INLINE CameraRay Project(V3 film) { return {Splat3(0, 0, 0), film}; }
};

Stage PerspectiveCameraStage() {
  return MakeCameraStage("camera_perspective",
                         "rays from one point, and the first values of a path",
                         Feature::kPerspective, ResolveCamera<Perspective>);
}

struct Orthographic {
  static HWY_INLINE CameraRay Project(V3 film) { return {film, Splat3(0, 0, 1)}; }
};

Stage OrthographicCameraStage() {
  return MakeCameraStage("camera_orthographic",
                         "parallel rays, and the first values of a path",
                         Feature::kOrthographic, ResolveCamera<Orthographic>);
}

// Spherical cameras:
//   equirectangular   (s, t) of the film = (longitude / 2 pi, colatitude / pi)
//   equal-area        the octahedral map of kernels/warp/sphere-inl.h; where a pixel
//                     filter leaves the film it goes on across the square's edge
// Both about the camera's y axis, which is up, as pbrt has it.
struct Equirectangular {
  static HWY_INLINE CameraRay Project(V3 film) {
    const auto [sin_phi, cos_phi] = SinCos2Pi(film.x);
    const auto [sin_theta, cos_theta] = SinCos2Pi(hn::Mul(film.y, Splat(0.5f)));
    return {Splat3(0, 0, 0),
            {hn::Mul(sin_theta, cos_phi), cos_theta, hn::Mul(sin_theta, sin_phi)}};
  }
};

struct EqualArea {
  static HWY_INLINE CameraRay Project(V3 film) {
    VF s = film.x, t = film.y;
    // Across an edge of the square lies the same edge, mirrored about its middle.
    const VF one = Splat(1.0f), zero = Splat(0);
    const MF beside = hn::Or(hn::Lt(s, zero), hn::Gt(s, one));
    t = hn::IfThenElse(beside, hn::Sub(one, t), t);
    s = Reflected(s);
    const MF above = hn::Or(hn::Lt(t, zero), hn::Gt(t, one));
    s = hn::IfThenElse(above, hn::Sub(one, s), s);
    t = Reflected(t);
    const V3 d = OctahedralDirection(s, t);
    return {Splat3(0, 0, 0), {d.x, d.z, d.y}};
  }
  static HWY_INLINE VF Reflected(VF x) {
    const VF two = Splat(2.0f);
    const VF low = hn::Abs(x);
    return hn::IfThenElse(hn::Gt(low, Splat(1.0f)), hn::Sub(two, low), low);
  }
};

template <bool kBox>
void SphericalRays(Wave& wave) {
  if (wave.camera->mapping == SphericalMapping::kEqualArea) {
    Camera<EqualArea, kBox, false>(wave);
  } else {
    Camera<Equirectangular, kBox, false>(wave);
  }
}

Stage SphericalCameraStage() {
  return MakeCameraStage(
      "camera_spherical", "rays in all directions, and the first values of a path",
      Feature::kSphericalCamera,
      ByFeature<Feature::kFiltered, SphericalRays<false>, SphericalRays<true>>);
}

LANELIGHT_END_KERNELS
