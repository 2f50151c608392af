#include "src/scene/compile/world_frame.h"

#include <cmath>

namespace lanelight {
namespace {

// Keeps scale and scale^2 finite and normal for the most absurd of inputs.
constexpr int kMaxExponent = 400;

}  // namespace

void Box::Add(Vec3d p) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return;
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

}  // namespace lanelight
