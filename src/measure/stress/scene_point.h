// Renders a scene that is written on the spot and makes a point of what it came to.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "src/measure/stress/stress_case.h"
#include "src/render/job/job.h"

namespace lanelight::stress {

/// A scene as pbrt text (no files), and how to render it.
struct SceneText {
  std::string text;
  RenderSettings settings;  // resolution, spp, seed, strategy, depth
};

/// Parses, compiles and plans. Throws InputError for what is refused.
Job PrepareText(const SceneText& scene);
/// The same, and renders.
JobRun RenderText(const SceneText& scene);

/// Returns the mean over all pixels and channels, counts of rays, invalid samples, lanes
/// and seconds. The standard error comes from the pixels' own variances; where pixels
/// depend on each other it is an upper bound. It is NaN if a pixel has fewer than two
/// observations, so that the point cannot pass.
Point MeanOf(const JobRun& rendered);

}  // namespace lanelight::stress
