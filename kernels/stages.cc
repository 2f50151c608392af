// The stages of all targets, found by name.
#include "kernels/simd/each_target-inl.h"

#include "kernels/stages.h"

LANELIGHT_BEGIN_KERNELS

#define X(name) Stage name##Stage();
LANELIGHT_STAGES(X)
#undef X

LANELIGHT_END_KERNELS

#if HWY_ONCE
namespace lanelight {

// What a stage says of itself is the same for all targets; its kernel is that of the
// target that is chosen when it is resolved.
#define X(name)                                                     \
  HWY_EXPORT(name##Stage);                                          \
  Stage name##Stage() {                                             \
    Stage stage = HWY_DYNAMIC_DISPATCH(name##Stage)();              \
    stage.resolve = [](const FeatureSet& features) {                \
      return HWY_DYNAMIC_DISPATCH(name##Stage)().resolve(features); \
    };                                                              \
    return stage;                                                   \
  }
LANELIGHT_STAGES(X)
#undef X

}  // namespace lanelight
#endif  // HWY_ONCE
