// What cases ask of single rays: are they hit where they should be, and do rays that
// leave there meet anything?
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "src/measure/stress/cases/draws.h"
#include "src/measure/stress/cases/points.h"
#include "src/measure/stress/cases/scene_text.h"
#include "src/measure/stress/trace_rays.h"

namespace lanelight::stress {

/// Rays into a scene, and what becomes of them.
struct RayTrial {
  RayTracer tracer;
  std::vector<WorldRay> rays;
  std::vector<Vec3d> leaving;  // where rays have hit

  RayTrial(const Effort& effort, const std::string& shapes, Vec3d eye = {0, 0, 5})
      : tracer(effort.target, RayScene(shapes, eye)) {}

  /// Adds a ray in a direction that ends at `target`.
  void Aim(Vec3d target, Vec3d direction, double distance) {
    rays.push_back({target - distance * direction, direction});
  }

  /// Traces the rays: how many hits are not good(hit, number).
  template <class Good>
  std::uint64_t CountBad(const Good& good) {
    const std::vector<WorldHit> hits = tracer.Trace(rays);
    std::uint64_t bad = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) bad += !good(hits[i], i);
    return bad;
  }
  /// The largest of error(hit, number); a ray that hits nothing is off by 1.
  template <class Error>
  double Worst(const Error& error) {
    const std::vector<WorldHit> hits = tracer.Trace(rays);
    double worst = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      worst = std::max(worst, hits[i].found ? error(hits[i], i) : 1.0);
    }
    return worst;
  }
  /// After tracing: how many of those that leave meet something within that length.
  std::uint64_t CountMet(double length = std::numeric_limits<double>::infinity()) {
    const std::vector<bool> met = tracer.Blocked(leaving, length);
    return static_cast<std::uint64_t>(std::count(met.begin(), met.end(), true));
  }
};

}  // namespace lanelight::stress
