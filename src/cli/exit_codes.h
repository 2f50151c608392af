// The exit codes of `lanelight` (docs/output.md).
#pragma once

namespace lanelight {

enum ExitCode : int {
  kExitGood = 0,
  kExitBadInput = 1,        // a file cannot be read, understood or written
  kExitUsage = 2,           // wrong flags
  kExitInvalidSamples = 3,  // the image was written, but some samples were not numbers
  kExitOverLimit = 4,       // compare: the error exceeds --max-relmse
  kExitTargetMissed = 5,    // render: the image was written, above the target error
  kExitInterrupted = 6,     // a signal came; what was done is kept, to go on from
  kExitStressFailed = 7,    // stress: a case failed
  kExitImageDiffers = 8,    // render: the image is not what the scene file asks for
  kExitSlower = 9,          // bench, profile: slower than what it was compared with
  kExitNotComparable = 10,  // bench, profile: other renders, or a very busy machine
};

}  // namespace lanelight
