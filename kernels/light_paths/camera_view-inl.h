// A perspective camera seen from the scene: where a direction meets the film, and the
// density of the directions in which samples of a pixel start.
#ifndef LANELIGHT_LIGHT_PATHS_CAMERA_VIEW_INL_H_
#define LANELIGHT_LIGHT_PATHS_CAMERA_VIEW_INL_H_

#include "kernels/simd/vec3-inl.h"
#include "src/scene/compiled/camera.h"

LANELIGHT_BEGIN_KERNELS

/// For directions w from a point of the lens, unit, in the scene: A = (right, up,
/// forward) takes camera space to the scene, and the film lies at depth 1.
struct CameraView {
  const CompiledCamera& camera;
  Vec3f row[3];   // of the inverse of A
  float inverse;  // of |det A| times the area of a pixel at depth 1

  HWY_INLINE explicit CameraView(const CompiledCamera& c) : camera(c) {
    const Vec3f a = Cross(c.up, c.forward), b = Cross(c.forward, c.right);
    const Vec3f d = Cross(c.right, c.up);
    const float det = Dot(c.right, a);
    row[0] = a / det;
    row[1] = b / det;
    row[2] = d / det;
    const float pixel = c.dx.x * c.dy.y - c.dx.y * c.dy.x;
    inverse = 1 / (std::abs(det) * std::abs(pixel));
  }

  HWY_INLINE V3 ToCamera(V3 w) const {
    const auto along = [&](Vec3f r) HWY_ATTR { return Dot(w, Splat3(r.x, r.y, r.z)); };
    return {along(row[0]), along(row[1]), along(row[2])};
  }
  /// Returns pixels^2 per solid angle: the density of samples of a pixel whose position
  /// is uniform over it.
  HWY_INLINE VF Density(V3 w) const {
    const VF z = Dot(w, Splat3(row[2].x, row[2].y, row[2].z));
    return hn::Div(Splat(inverse), hn::Mul(z, hn::Mul(z, z)));
  }
  /// Returns the point of the film, in pixels (x, y), of the ray through `lens` (camera
  /// space) in the direction w; z > 0: it comes from the front.
  HWY_INLINE V3 FilmPoint(V3 lens, V3 w) const {
    const V3 d = ToCamera(w);
    const VF scale = hn::Div(Splat(1.0f), d.z);
    const VF focus = Splat(1 / camera.focal_distance);
    const VF px = hn::MulAdd(d.x, scale, hn::Mul(lens.x, focus));
    const VF py = hn::MulAdd(d.y, scale, hn::Mul(lens.y, focus));
    const VF qx = hn::Sub(px, Splat(camera.base.x));
    const VF qy = hn::Sub(py, Splat(camera.base.y));
    const float det = camera.dx.x * camera.dy.y - camera.dx.y * camera.dy.x;
    const VF x =
        hn::MulSub(qx, Splat(camera.dy.y / det), hn::Mul(qy, Splat(camera.dy.x / det)));
    const VF y =
        hn::MulSub(qy, Splat(camera.dx.x / det), hn::Mul(qx, Splat(camera.dx.y / det)));
    return {x, y, d.z};
  }
};

LANELIGHT_END_KERNELS

#endif
