// The cases of the stress suite, one function per file.
#pragma once

#include <vector>

#include "src/measure/stress/stress_case.h"

namespace lanelight::stress {

// In the order of the report. X(name): Add<name>Cases, each in a file of its own.
// clang-format off
#define LANELIGHT_STRESS_CASES(X)                                                     \
  X(Unit)                                                                             \
  /* Materials. */                                                                    \
  X(Roughness)                                                                        \
  /* Lights, and the way from them. */                                                \
  X(LightSize) X(ManyLight) X(Radiance) X(Transport) X(Reuse)                         \
  /* Strategies. */                                                                   \
  X(Strategy)
// clang-format on

#define X(name) void Add##name##Cases(std::vector<Case>& cases);
LANELIGHT_STRESS_CASES(X)
#undef X

/// All of them.
inline std::vector<Case> AllCases() {
  std::vector<Case> cases;
#define X(name) Add##name##Cases(cases);
  LANELIGHT_STRESS_CASES(X)
#undef X
  return cases;
}

}  // namespace lanelight::stress
