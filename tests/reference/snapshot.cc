#include "tests/reference/snapshot.h"

#include <cmath>

namespace lanelight::reference {
namespace {

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

double Dot(const Quaternion& a, const Quaternion& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

Quaternion Mix(const Quaternion& a, double s, const Quaternion& b, double t) {
  return {a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t, a.w * s + b.w * t};
}

// Entry by entry: of linear parts; the rest is that of the identity.
Transform Mix(const Transform& a, double s, const Transform& b, double t) {
  Transform::Matrix m = Transform().matrix();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[r][c] = s * a(r, c) + t * b(r, c);
  }
  return Transform(m);
}

struct Parts {
  Vec3d move;
  Quaternion turn;
  Transform rest;
};

// Returns the quaternion of a rotation.
Quaternion QuaternionOf(const Transform& r) {
  Quaternion q = {r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1),
                  1 + r(0, 0) + r(1, 1) + r(2, 2)};
  // If w is small, the largest of the others leads.
  if (q.w < 0.1) {
    const double xx = 1 + r(0, 0) - r(1, 1) - r(2, 2);
    const double yy = 1 - r(0, 0) + r(1, 1) - r(2, 2);
    const double zz = 1 - r(0, 0) - r(1, 1) + r(2, 2);
    const double xy = r(0, 1) + r(1, 0), yz = r(1, 2) + r(2, 1), zx = r(2, 0) + r(0, 2);
    if (xx >= yy && xx >= zz) {
      q = {xx, xy, zx, q.x};
    } else if (yy >= zz) {
      q = {xy, yy, yz, q.y};
    } else {
      q = {zx, yz, zz, q.z};
    }
  }
  return Mix(q, 1 / std::sqrt(Dot(q, q)), {}, 0);
}

Parts Decompose(const Transform& t) {
  const Vec3d move = t.Point({0, 0, 0});
  const Transform linear = Mix(t, 1, t, 0);
  Transform turn = linear;
  for (int i = 0; i < 200; ++i) turn = Mix(turn, 0.5, turn.Inverse().Transposed(), 0.5);
  if (t.SwapsHandedness()) turn = Mix(turn, -1, turn, 0);
  return {move, QuaternionOf(turn), turn.Transposed() * linear};
}

Transform TurnOf(const Quaternion& q) {
  const auto [x, y, z, w] = q;
  return Transform(
      {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0},
        {0, 0, 0, 1}}});
}

Quaternion Slerp(const Quaternion& a, Quaternion b, double t) {
  if (Dot(a, b) < 0) b = Mix(b, -1, {}, 0);
  const double angle = std::acos(std::min(1.0, Dot(a, b)));
  if (angle < 1e-8) return a;
  return Mix(a, std::sin((1 - t) * angle) / std::sin(angle), b,
             std::sin(t * angle) / std::sin(angle));
}

void Stop(double time, Transform* start, EndTransform* end) {
  if (*end != nullptr) *start = Interpolate(*start, **end, time);
  *end = nullptr;
}

}  // namespace

Transform Interpolate(const Transform& start, const Transform& end, double time) {
  const Parts a = Decompose(start), b = Decompose(end);
  const Vec3d move = a.move * (1 - time) + b.move * time;
  return Transform::Translate(move) * TurnOf(Slerp(a.turn, b.turn, time)) *
         Mix(a.rest, 1 - time, b.rest, time);
}

SceneDescription Snapshot(const SceneDescription& scene, double time) {
  SceneDescription still = scene;
  Stop(time, &still.camera.world_from_camera, &still.camera.end);
  for (Instance& instance : still.instances) {
    Stop(time, &instance.world_from_object, &instance.end);
  }
  return still;
}

}  // namespace lanelight::reference
