// What a run of stress cases returns to the shell.
#pragma once

#include "src/cli/exit_codes.h"
#include "src/measure/stress/suite.h"

namespace lanelight {

/// A failed case outweighs an interruption. A weak case is no failure.
inline ExitCode ExitCodeOf(const stress::SuiteResult& result) {
  if (result.Count(stress::Outcome::kFailed) > 0) return kExitStressFailed;
  return result.interrupted ? kExitInterrupted : kExitGood;
}

}  // namespace lanelight
