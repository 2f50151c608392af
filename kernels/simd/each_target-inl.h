// Every file with vector code includes this first. Highway then includes the file again
// for each target. The build names that file, a kernel or a group of kernels
// (HWY_TARGET_INCLUDE, cmake/kernel_groups.cmake).
#include "kernels/targets.h"

#include "hwy/foreach_target.h"
#include "hwy/highway.h"

// The first file of each target undefines the include guards of kernel headers, so that
// each header is read once per target. The build generates the list from their paths.
#if defined(LANELIGHT_SIMD_EACH_TARGET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LANELIGHT_SIMD_EACH_TARGET_INL_H_
#undef LANELIGHT_SIMD_EACH_TARGET_INL_H_
#else
#define LANELIGHT_SIMD_EACH_TARGET_INL_H_
#endif
#include "generated/kernel_guards.h"
#endif
