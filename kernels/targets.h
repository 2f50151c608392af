// Included first by every kernel file: which Highway targets are compiled, and why not
// the others. At run time the best one that the machine has is chosen; `--target` forces
// one (kernels/simd/target.h).
//
//   AVX3   16 lanes, compress and gather in hardware: what the design is for
//   AVX2   8 lanes, gather in hardware
//   SSE4   4 lanes: the floor for machines sold since 2008
//   EMU128 4 lanes in plain C++: runs anywhere, and is the reference of the tests
// Not compiled: SSSE3 (machines between 2006 and 2008; EMU128 serves them), AVX3_DL (no
// instruction of it is used), NEON and others (nothing stands in the way, not tested).
#pragma once

#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
