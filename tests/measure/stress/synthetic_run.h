// A run of planted cases of every kind, as if on two SIMD targets: what files and pages
// are tested with.
#pragma once

#include "src/measure/stress/suite.h"

namespace lanelight::stress {

/// A point of a curve whose error swings with x, different for every kind; from 1e3 on it
/// is off by 0.3 kind.
Point SwingingPoint(const std::string& series, double x, int kind);

/// Cases: strategies, shapes, wrong-inside (fails), noisy (weak), rare (a rate), angle (a
/// linear axis), single (no map). Some texts would be markup.
SuiteResult SyntheticRun();

}  // namespace lanelight::stress
