// The stages of all targets, found by name and target.
#include "kernels/simd/each_target-inl.h"

#include "kernels/stages.h"

LANELIGHT_BEGIN_KERNELS

#define X(name) Stage name##Stage();
LANELIGHT_STAGES(X)
#undef X

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

#define X(name)            \
  HWY_EXPORT(name##Stage); \
  Stage name##Stage(SimdTarget target) { return LANELIGHT_ON(target, name##Stage)(); }
LANELIGHT_STAGES(X)
#undef X

}  // namespace lanelight
#endif  // HWY_ONCE
