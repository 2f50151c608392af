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

/// Mean over all pixels and the three channels, with its standard error from the pixels'
/// own variances, at most where they depend on each other (NaN where a pixel has fewer
/// than two observations, so that the point cannot pass), counts of rays, invalid
/// samples, lanes and seconds.
Point MeanOf(const JobRun& rendered);

}  // namespace lanelight::stress
