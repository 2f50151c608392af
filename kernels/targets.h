// The Highway targets that kernels are compiled for, and the macros around their code.
// LANELIGHT_TARGETS, a list of some of these, comes from the build (cmake/targets.cmake).
// At run time the best one that the machine has is chosen; `--simd` forces one
// (kernels/simd/target.h).
//
//   AVX3   AVX-512: 16 lanes, compress and gather in hardware; the main target
//   AVX2   8 lanes, gather in hardware
//   SSE4   4 lanes (with AES and carry-less products): machines since 2010
//   NEON   4 lanes: all 64-bit ARM (docs/arm64.md)
//   EMU128 4 lanes in plain C++, on request only: runs anywhere, but 30 times slower
// Never compiled: SSSE3 (machines of 2006 to 2010 can use EMU128), AVX3_DL (none of its
// instructions is used), and SVE: vectors without a size at compile time cannot be
// members of classes or lie in arrays. Others are not tested.
#pragma once

#ifndef LANELIGHT_TARGETS
#error "kernels are compiled with KERNEL_OPTIONS of cmake/targets.cmake"
#endif

// Kernels assume the last target, which may be more than other files assume. Highway
// compiles it and all better ones that are not disabled.
#define HWY_DISABLED_TARGETS (~(LANELIGHT_TARGETS))
#define HWY_BASELINE_TARGETS LANELIGHT_FLOOR_TARGET

// Code between these is compiled for each target, in a namespace of its own
// (kernels/simd/each_target-inl.h).
#define LANELIGHT_BEGIN_KERNELS \
  HWY_BEFORE_NAMESPACE();       \
  namespace lanelight {         \
  namespace HWY_NAMESPACE {
#define LANELIGHT_END_KERNELS \
  }                           \
  }                           \
  HWY_AFTER_NAMESPACE();
