// Included first by every file with vector code: has the file compiled once per target.
// Highway does so by including it again. Which file that is, one or a group of kernels,
// is said by the build (HWY_TARGET_INCLUDE, cmake/kernel_groups.cmake).
//
// So there is no guard here, and those of the other -inl.h files let them in once per
// target.
#include "kernels/targets.h"

#include "hwy/foreach_target.h"
#include "hwy/highway.h"
