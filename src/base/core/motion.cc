#include "src/base/core/motion.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/check.h"
#include "src/base/core/motion_record.h"
#include "src/base/core/pi.h"

namespace lanelight {
namespace {

using Matrix3 = Motion::Matrix3;

// Negligible rotations, in radians; matrix entries below this are rounding.
constexpr double kNoAngle = 1e-12, kRounding = 1e-13;

Matrix3 LinearOf(const Transform& t) {
  Matrix3 m;
  for (int r = 0; r < 3; ++r) m[r] = {t(r, 0), t(r, 1), t(r, 2)};
  return m;
}

Vec3d Times(const Matrix3& m, Vec3d v) {
  return {Dot(m[0], v), Dot(m[1], v), Dot(m[2], v)};
}

Matrix3 Transposed(const Matrix3& m) {
  return {{{m[0].x, m[1].x, m[2].x}, {m[0].y, m[1].y, m[2].y}, {m[0].z, m[1].z, m[2].z}}};
}

Matrix3 Times(const Matrix3& a, const Matrix3& b) {
  const Matrix3 columns = Transposed(b);
  return {Times(columns, a[0]), Times(columns, a[1]), Times(columns, a[2])};
}

Matrix3 Sum(const Matrix3& a, double s, const Matrix3& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

double NormOf(const Matrix3& m) {
  return std::sqrt(Dot(m[0], m[0]) + Dot(m[1], m[1]) + Dot(m[2], m[2]));
}

// Transposed inverse.
Matrix3 Cofactors(const Matrix3& m) {
  const Matrix3 c = {Cross(m[1], m[2]), Cross(m[2], m[0]), Cross(m[0], m[1])};
  const double determinant = Dot(m[0], c[0]);
  return {c[0] / determinant, c[1] / determinant, c[2] / determinant};
}

// The rotation of m, negated if m mirrors, by Newton's iteration of the polar
// decomposition (Higham 1986).
Matrix3 RotationOf(Matrix3 m) {
  const double size = NormOf(m);
  m = {m[0] / size, m[1] / size, m[2] / size};
  for (int step = 0; step < 100; ++step) {
    const Matrix3 other = Cofactors(m);
    const Matrix3 next = {0.5 * (m[0] + other[0]), 0.5 * (m[1] + other[1]),
                          0.5 * (m[2] + other[2])};
    const double moved = NormOf(Sum(next, -1, m));
    m = next;
    if (moved < 1e-15) break;
  }
  return m;
}

// Rotation by `angle` about the unit vector k (Rodrigues).
Matrix3 Turn(Vec3d k, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double half = std::sin(angle / 2), rest = 2 * half * half;  // 1 - c
  return {
      {{c + rest * k.x * k.x, rest * k.x * k.y - s * k.z, rest * k.x * k.z + s * k.y},
       {rest * k.y * k.x + s * k.z, c + rest * k.y * k.y, rest * k.y * k.z - s * k.x},
       {rest * k.z * k.x - s * k.y, rest * k.z * k.y + s * k.x, c + rest * k.z * k.z}}};
}

// Axis and angle of a rotation. Half a turn has no direction: its axis then has a
// positive largest component.
void FindRotation(const Matrix3& r, Vec3d* axis, double* angle) {
  // The axis times twice the sine of the angle, and twice the cosine.
  const Vec3d w = {r[2].y - r[1].z, r[0].z - r[2].x, r[1].x - r[0].y};
  const double cosine2 = r[0].x + r[1].y + r[2].z - 1, sine2 = Length(w);
  *angle = std::atan2(sine2, cosine2);
  if (*angle < kNoAngle) {
    *angle = 0;
    return;
  }
  if (cosine2 > -1.9) {
    *axis = w / sine2;
    return;
  }
  // Near half a turn w says little. The symmetric part is c I + (1 - c) k k'.
  const double c = cosine2 / 2;
  const Vec3d squares = {r[0].x - c, r[1].y - c, r[2].z - c};
  int largest = 0;
  for (int a = 1; a < 3; ++a) largest = squares[a] > squares[largest] ? a : largest;
  Vec3d k;
  for (int a = 0; a < 3; ++a) k[a] = 0.5 * (r[a][largest] + r[largest][a]);
  k[largest] -= c;
  k = Normalize(k);
  *axis = sine2 > kNoAngle && Dot(k, w) < 0 ? -k : k;
}

void Store(Vec3d v, float out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

Vec3d Load(const float v[3]) { return {v[0], v[1], v[2]}; }

// The power of two that is nearest below the largest entry.
double UnitOf(const Motion::Matrix3& linear) {
  double largest = 0;
  for (const Vec3d& row : linear) {
    const Vec3d a = Max(row, -row);
    largest = std::max({largest, a.x, a.y, a.z});
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(0.5, exponent);
}

}  // namespace

Motion::Motion(const Transform& start, const Transform& end) : linear(LinearOf(start)) {
  LL_CHECK(HaveMotion(start, end));
  from = start.Point({0, 0, 0});
  way = end.Point({0, 0, 0}) - from;
  const Matrix3 last = LinearOf(end);
  if (last == linear) return;
  const Matrix3 rotation = Times(RotationOf(last), Transposed(RotationOf(linear)));
  FindRotation(rotation, &axis, &angle);
  // What is turned at the end, so that R(1) (linear + change) = last.
  change = Sum(Times(Transposed(Turn(axis, angle)), last), -1, linear);
  if (NormOf(change) < kRounding * NormOf(linear)) change = {};
}

Transform Motion::At(double s) const {
  const Matrix3 m = Times(Turn(axis, s * angle), Sum(linear, s, change));
  const Vec3d move = from + s * way + Times(m, pivot);
  return Transform({{{m[0].x, m[0].y, m[0].z, move.x},
                     {m[1].x, m[1].y, m[1].z, move.y},
                     {m[2].x, m[2].y, m[2].z, move.z},
                     {0, 0, 0, 1}}});
}

double Motion::Deviation(double reach) const {
  if (angle == 0) return 0;
  // The second derivative turns with R(s): angle^2 k x (k x v) + 2 angle k x v', where
  // v = (linear + s change) (pivot + p).
  const double radius = Length(pivot) + std::sqrt(3.0) * reach;
  const double v = (NormOf(linear) + NormOf(change)) * radius;
  const double bend = angle * angle * v + 2 * angle * NormOf(change) * radius;
  const double part = 1.0 / Parts();
  return bend * part * part / 8;
}

MotionRecord RecordOf(const Motion& motion) {
  MotionRecord record;
  const double unit = UnitOf(motion.linear);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      record.linear[c][r] = static_cast<float>(motion.linear[r][c] / unit);
      record.change[c][r] = static_cast<float>(motion.change[r][c] / unit);
    }
  }
  Store(motion.from, record.from);
  Store(motion.way, record.way);
  Store(motion.pivot, record.pivot);
  Store(motion.axis, record.axis);
  record.turns = static_cast<float>(motion.angle / (2 * kPi));
  record.unit = static_cast<float>(unit);
  return record;
}

Motion MotionOf(const MotionRecord& record) {
  Motion motion;
  const double unit = record.unit;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      motion.linear[r][c] = record.linear[c][r] * unit;
      motion.change[r][c] = record.change[c][r] * unit;
    }
  }
  motion.from = Load(record.from);
  motion.way = Load(record.way);
  motion.pivot = Load(record.pivot);
  motion.axis = Load(record.axis);
  motion.angle = record.turns * (2 * kPi);
  return motion;
}

}  // namespace lanelight
