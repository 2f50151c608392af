// Benchmarks time right images only.
#pragma once

#include <string>

#include "src/render/job.h"

namespace lanelight {

struct Verdict {
  bool good = false;
  std::string text;  // what was compared, or why nothing was
};

/// Renders the job and compares the mean of each channel with that of reference-a.exr and
/// reference-b.exr in the directory of `scene`: the relative difference must stay below
/// `tolerance` plus three standard errors, estimated from both the render and the
/// difference of the two references. Good, with a text that says so, if there is no
/// reference of that size. Any invalid sample is bad.
Verdict VerifyAgainstReference(const Job& job, const std::string& scene,
                               double tolerance);

}  // namespace lanelight
