#include "src/base/core/motion_record.h"

#include <algorithm>
#include <cmath>

#include "src/base/core/pi.h"

namespace lanelight {
namespace {

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
