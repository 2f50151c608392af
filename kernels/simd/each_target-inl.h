// Included first by every file with vector code: has the file compiled once per target.
// Highway does so by including it again. Which file that is, one or a group of kernels,
// is said by the build (HWY_TARGET_INCLUDE, cmake/kernel_groups.cmake).
#include "kernels/targets.h"

#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// At the first file of each target, what guards the headers of kernels is taken back:
// each is read once per target. The build writes the list of them all, by their paths.
#if defined(LANELIGHT_SIMD_EACH_TARGET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_SIMD_EACH_TARGET_INL_H_
#undef LANELIGHT_SIMD_EACH_TARGET_INL_H_
#else
#define LANELIGHT_SIMD_EACH_TARGET_INL_H_
#endif
#include "generated/kernel_guards.h"
#endif
