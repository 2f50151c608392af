// Which Highway targets kernels are compiled for, and why not for others; and what their
// code stands between. LANELIGHT_TARGETS, a list of some of these, comes from the build
// (cmake/targets.cmake). At run time the best one that the machine has is chosen;
// `--simd` forces one (kernels/simd/target.h).
//
//   AVX3   16 lanes, compress and gather in hardware: what the design is for
//   AVX2   8 lanes, gather in hardware
//   SSE4   4 lanes (with AES and carry-less products): the floor, machines since 2010
//   NEON   4 lanes: all 64-bit ARM (docs/arm64.md)
//   EMU128 4 lanes in plain C++, only where it is asked for: runs anywhere, takes the
//          longest to compile of all, and 30 times as long to run
// Never compiled: SSSE3 (machines of 2006 to 2010; EMU128 serves them), AVX3_DL (no
// instruction of it is used), SVE in all forms: a vector without a size at compile time
// cannot be a member of a class or lie in an array, which ours do (Vec3 of lanes, hits,
// BSDF lobes). Others: nothing stands in the way, not tested.
#pragma once

#ifndef LANELIGHT_TARGETS
#error "kernels are compiled with KERNEL_OPTIONS of cmake/targets.cmake"
#endif

// The last target is what kernels take for granted, which is more than their compiler may
// elsewhere: Highway compiles it, and all better ones that are not disabled.
#define HWY_DISABLED_TARGETS (~(LANELIGHT_TARGETS))
#define HWY_BASELINE_TARGETS LANELIGHT_FLOOR_TARGET

// What stands between these is compiled for each target, in a namespace of its own
// (kernels/simd/each_target-inl.h).
#define LANELIGHT_BEGIN_KERNELS \
  HWY_BEFORE_NAMESPACE();       \
  namespace lanelight {         \
  namespace HWY_NAMESPACE {
#define LANELIGHT_END_KERNELS \
  }                           \
  }                           \
  HWY_AFTER_NAMESPACE();
