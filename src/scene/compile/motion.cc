#include "src/scene/compile/motion.h"

namespace lanelight {
namespace {

using Matrix3 = Motion::Matrix3;

Vec3d Times(const Matrix3& m, Vec3d v) {
  return {Dot(m[0], v), Dot(m[1], v), Dot(m[2], v)};
}

}  // namespace

// scene = (from + s way + R(s) L(s) p - centre) * scale, p = object / scale' + centre'.
Motion InFrames(const Motion& motion, const WorldFrame& scene, const WorldFrame& object) {
  Motion framed = motion;
  const double ratio = scene.scale / object.scale;
  for (int r = 0; r < 3; ++r) {
    framed.linear[r] *= ratio;
    framed.change[r] *= ratio;
  }
  framed.from = scene.Point(motion.from);
  framed.way = motion.way * scene.scale;
  framed.pivot = object.center * object.scale;
  if (motion.angle != 0) return framed;
  // Nothing turns about the origin of the object, which may lie far off.
  framed.from += Times(framed.linear, framed.pivot);
  framed.way += Times(framed.change, framed.pivot);
  framed.pivot = {};
  return framed;
}

// M(s) M(0)^-1 q = from + s way + R(s) (1 + s change linear^-1) (q - from).
Motion OfCamera(const Motion& motion, const WorldFrame& scene) {
  Motion moved;
  moved.from = scene.Point(motion.from);
  moved.way = motion.way * scene.scale;
  moved.pivot = -moved.from;
  moved.axis = motion.axis;
  moved.angle = motion.angle;
  const Matrix3& m = motion.linear;
  const Vec3d c0 = Cross(m[1], m[2]), c1 = Cross(m[2], m[0]), c2 = Cross(m[0], m[1]);
  const double determinant = Dot(m[0], c0);
  for (int r = 0; r < 3; ++r) {
    const Vec3d row = motion.change[r];
    moved.change[r] = Vec3d{Dot(row, c0), Dot(row, c1), Dot(row, c2)} / determinant;
  }
  return moved;
}

}  // namespace lanelight
