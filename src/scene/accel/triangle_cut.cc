#include "src/scene/accel/triangle_cut.h"

#include <algorithm>
#include <cmath>

namespace lanelight {
namespace {

float RoundDown(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -INFINITY) : f;
}
float RoundUp(double x) {
  const auto f = static_cast<float>(x);
  return f < x ? std::nextafter(f, INFINITY) : f;
}

AccelBox Common(const AccelBox& a, const AccelBox& b) {
  return {Max(a.lo, b.lo), Min(a.hi, b.hi)};
}

// Extends both boxes by the point where the edge from `a` to `b`, which crosses the
// plane, meets it. The point is computed in double precision and has an error of at most
// 5 unit roundoffs (2^-53) of |a| + |b|; it lies between a and b.
void ExtendByCrossing(const float* a, const float* b, int axis, float x, CutBoxes& cut) {
  const double t = (double{x} - a[axis]) / (double{b[axis]} - a[axis]);
  AccelBox point;
  for (int i = 0; i < 3; ++i) {
    const double p = a[i] + t * (double{b[i]} - a[i]);
    const double error = 0x1p-50 * (std::abs(double{a[i]}) + std::abs(double{b[i]}));
    point.lo[i] = std::max(RoundDown(p - error), std::min(a[i], b[i]));
    point.hi[i] = std::min(RoundUp(p + error), std::max(a[i], b[i]));
  }
  point.lo[axis] = point.hi[axis] = x;
  cut.left.Extend(point);
  cut.right.Extend(point);
}

}  // namespace

bool IsEmpty(const AccelBox& box) {
  return box.hi.x < box.lo.x || box.hi.y < box.lo.y || box.hi.z < box.lo.z;
}

CutBoxes CutTriangle(const TriangleRecord& triangle, const AccelBox& box, int axis,
                     float x) {
  CutBoxes cut;
  for (int k = 0; k < 3; ++k) {
    const float* a = triangle.p[k];
    const float* b = triangle.p[k == 2 ? 0 : k + 1];
    const Vec3f corner{a[0], a[1], a[2]};
    if (a[axis] <= x) cut.left.Extend(corner);
    if (a[axis] >= x) cut.right.Extend(corner);
    if ((a[axis] < x && b[axis] > x) || (a[axis] > x && b[axis] < x)) {
      ExtendByCrossing(a, b, axis, x, cut);
    }
  }
  cut.left = Common(cut.left, box);
  cut.right = Common(cut.right, box);
  return cut;
}

}  // namespace lanelight
