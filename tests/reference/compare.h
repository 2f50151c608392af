// From a reference image to the statistics of tests/base/stat.
#pragma once

#include "tests/base/stat/compare_means.h"
#include "tests/reference/path_tracer.h"

namespace lanelight::test {

inline stat::ImageEstimate Estimate(const ReferenceImage& image) {
  return {image.width, image.height, static_cast<double>(image.samples), image.mean,
          image.variance_of_mean};
}

/// Renders and compares with a closed form f(x, y) per pixel (x, y integer).
inline stat::ImageTestResult CompareWithClosedForm(
    const SceneDescription& scene, const TwinOptions& options,
    const std::function<Rgb(int, int)>& f, const stat::ImageTestOptions& test = {}) {
  const ReferenceImage image = RenderReference(scene, options);
  return stat::CompareMeans(Estimate(image),
                            stat::ExpectedImage(image.width, image.height, f), test);
}

inline TwinOptions Options(ReferenceEstimator estimator, int samples) {
  TwinOptions options;
  options.estimator = estimator;
  options.samples = samples;
  return options;
}

}  // namespace lanelight::test
