#include "src/scene/compile/world_frame.h"

#include <cmath>

namespace lanelight {

namespace {

// Keeps scale and scale^2 finite and normal for any input.
constexpr int kMaxExponent = 400;

using Matrix3 = Motion::Matrix3;

Vec3d Times(const Matrix3& m, Vec3d v) {
  return {Dot(m[0], v), Dot(m[1], v), Dot(m[2], v)};
}

}  // namespace

void Box::Add(Vec3d p) {
  if (!IsFinite(p)) return;
  min = Min(min, p);
  max = Max(max, p);
}

void Box::Add(const Box& other) {
  if (other.empty()) return;
  Add(other.min);
  Add(other.max);
}

Box Box::Transformed(const Transform& transform) const {
  Box box;
  if (empty()) return box;
  for (int corner = 0; corner < 8; ++corner) {
    box.Add(transform.Point({corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y,
                             corner & 4 ? max.z : min.z}));
  }
  return box;
}

double Box::HalfDiagonal() const {
  const Vec3d half = max * 0.5 - min * 0.5;
  return std::hypot(half.x, half.y, half.z);  // squares could overflow or underflow
}

Transform WorldFrame::After(const Transform& transform) const {
  Transform::Matrix m = transform.matrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      m[row][column] = (m[row][column] - center[row] * m[3][column]) * scale;
    }
  }
  return Transform(m);
}

Transform WorldFrame::Inverse() const {
  const double s = 1 / scale;
  return Transform::Translate(center) * Transform::Scale({s, s, s});
}

WorldFrame FrameOf(const Box& box) {
  if (box.empty()) return {};
  WorldFrame frame;
  frame.center = box.Center();
  const double half = box.HalfDiagonal();
  if (half > 0 && std::isfinite(half)) {
    int exponent = 0;
    std::frexp(half, &exponent);  // half = m * 2^exponent, m in [1/2, 1)
    frame.scale = std::ldexp(1.0, std::clamp(1 - exponent, -kMaxExponent, kMaxExponent));
  }
  return frame;
}

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
  // Without rotation, the pivot (the object's origin, perhaps far away) is not needed.
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
