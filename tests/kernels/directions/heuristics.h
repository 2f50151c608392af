// Shared by the kernel and the checks of heuristic_test.cc.
#pragma once

#include "src/vocabulary/path/run_parameters.h"

namespace lanelight {

/// n, a multiple of 16, pairs of densities in; both weights out.
struct WeightBatch {
  int n;
  MisParameters mis;
  const float *light_pdf, *bsdf_pdf;
  float *of_light_sample, *of_emission;
};

}  // namespace lanelight
