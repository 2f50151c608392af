#include "kernels/probe/bsdf_probe.h"

#include "src/core/check.h"

namespace lanelight {

// One file each, so that they compile side by side; empty for a kind of another one.
BsdfProbe DiffuseBsdfProbe(ShadeKind kind);
BsdfProbe InterfaceBsdfProbe(ShadeKind kind);
BsdfProbe CoatedBsdfProbe(ShadeKind kind);

BsdfProbe GetBsdfProbe(ShadeKind kind) {
  for (auto* probe_of : {DiffuseBsdfProbe, InterfaceBsdfProbe, CoatedBsdfProbe}) {
    const BsdfProbe probe = probe_of(kind);
    if (probe.sample != nullptr) return probe;
  }
  FailCheck(__FILE__, __LINE__, "kind has a kernel");
}

}  // namespace lanelight
