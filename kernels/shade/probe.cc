#include "kernels/shade/probe.h"

#include "src/core/check.h"

namespace lanelight {

BsdfProbe GetBsdfProbe(ShadeKind kind) {
  switch (kind) {
#define X(name)         \
  case ShadeKind::name: \
    return MakeBsdfProbe<ShadeKind::name>();
    LANELIGHT_SHADE_KINDS(X)
#undef X
    case ShadeKind::kCount:
      break;
  }
  FailCheck(__FILE__, __LINE__, "kind has a kernel");
}

}  // namespace lanelight
