// A short render that says what long ones of the same scene and strategy will take.
#pragma once

#include <limits>

#include "src/render/job/job.h"

namespace lanelight {

struct ProbeRender {
  double pixels = 0;      // of the image
  std::uint64_t spp = 0;  // the scene's own
  double load_seconds = 0, build_seconds = 0;
  double sample_seconds = 0;   // wall clock of one sample
  double bytes_per_pixel = 0;  // of the image file
  /// Squared errors times samples per pixel; NaN: not known.
  double relmse = std::numeric_limits<double>::quiet_NaN();
  double mse = std::numeric_limits<double>::quiet_NaN();
};

/// Renders windows that are spread over the image, for about `seconds`, and no less than
/// kProbeSamples per pixel of them. `half`: colours of the file in 16 bits.
ProbeRender RenderProbe(const Job& job, double seconds, bool half);

inline constexpr std::uint64_t kProbeSamples = 4;

}  // namespace lanelight
