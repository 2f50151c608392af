// The registry of stages: one line each, in the order of execution. The plan keeps those
// that the scene needs (src/wavefront/plan.cc). A file in kernels/ with a stage and no
// line here fails tests/wavefront/registry_test.cc; a line without a file fails to link.
#pragma once

#include "src/wavefront/stage.h"

namespace lanelight {

#define LANELIGHT_STAGES(X)

#define X(name) Stage name##Stage();
LANELIGHT_STAGES(X)
#undef X

}  // namespace lanelight
