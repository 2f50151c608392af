// How an instance or the camera moves, as the kernels read it.
#pragma once

#include "src/base/core/motion.h"

namespace lanelight {

/// A Motion (src/base/core/motion.h): 32 words. At the time s the point p is at
///   from + s way + unit R(s) (linear + s change) (pivot + p).
struct MotionRecord {
  float linear[3][3], change[3][3];  // columns
  float from[3], way[3], pivot[3];
  float axis[3];  // unit
  float turns;    // angle of R(1) in turns, 0 to 1/2
  float unit;     // a power of two that brings `linear` near 1
};
static_assert(sizeof(MotionRecord) == 128);

MotionRecord RecordOf(const Motion& motion);
/// What the record says, in double precision.
Motion MotionOf(const MotionRecord& record);

}  // namespace lanelight
