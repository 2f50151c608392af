#include "src/prepare/guide_square.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

struct Frame {
  Vec3d s, t;
};

// Smooth in the normal but where |x| is 0.7: a bent cell should see one map.
Frame FrameAbout(Vec3d n) {
  const Vec3d axis = std::abs(n.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d s = Normalize(axis - n * Dot(n, axis));
  return {s, Cross(n, s)};
}

// 1 + t^2 at a point of [-1, 1]^2.
double Stretch(double a, double b) {
  const double large = std::max(std::abs(a), std::abs(b));
  const double t = large > 0 ? std::min(std::abs(a), std::abs(b)) / large : 0;
  return 1 + t * t;
}

}  // namespace

GuideSquarePoint ToGuideSquare(Vec3d normal, Vec3d direction) {
  const Frame frame = FrameAbout(normal);
  const double x = Dot(direction, frame.s), y = Dot(direction, frame.t);
  const double r = std::min(1.0, std::hypot(x, y));
  const double large = std::max(std::abs(x), std::abs(y));
  const double scale = large > 0 ? r / large : 0;
  const double a = std::clamp(x * scale, -1.0, 1.0), b = std::clamp(y * scale, -1.0, 1.0);
  const double z = Dot(direction, normal);
  return {(a + 1) / 2, (b + 1) / 2, z, Stretch(a, b) * z};
}

Vec3d FromGuideSquare(Vec3d normal, double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  const double shrink = 1 / std::sqrt(Stretch(a, b));
  const double x = a * shrink, y = b * shrink;
  const double z = std::sqrt(std::max(0.0, 1 - x * x - y * y));
  const Frame frame = FrameAbout(normal);
  return frame.s * x + frame.t * y + normal * z;
}

const std::array<double, kGuideSquares>& CosineMasses() {
  static const std::array<double, kGuideSquares> masses = [] {
    constexpr int n = 16;  // points along a side of each square: six digits
    std::array<double, kGuideSquares> of{};
    double sum = 0;
    for (std::size_t s = 0; s < kGuideSquares; ++s) {
      for (int i = 0; i < n * n; ++i) {
        const double a = double(s % kGuideGrid) + (i % n + 0.5) / n;
        const double b = double(s / kGuideGrid) + (i / n + 0.5) / n;
        of[s] += 1 / Stretch(2 * a / kGuideGrid - 1, 2 * b / kGuideGrid - 1);
      }
      sum += of[s];
    }
    for (double& mass : of) mass /= sum;
    return of;
  }();
  return masses;
}

}  // namespace lanelight
