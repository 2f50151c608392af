// Everything about a render or a plan that a script may want, as JSON. The schema is
// documented in docs/output.md ("JSON report"); kReportSchema changes when a member
// changes its meaning or goes away, not when one is added.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "src/render/estimate/estimate.h"
#include "src/render/job/job.h"
#include "src/scene/accel/bvh_report.h"

namespace lanelight {

inline constexpr int kReportSchema = 3;

struct RenderReport {
  std::string scene, exr, png;  // png empty: not written
  RunResult result;
  ErrorEstimate error;
  std::uint64_t unsampled_pixels = 0;  // of the film: without a sample, black
  bool has_holes = false;              // pixels that should have samples have none
  /// Images and report are in the PartialTargets() of this number, and the files asked
  /// for are unchanged; 0: they are in the files asked for. Without any sample there is
  /// no image.
  int partial_number = 0;
  bool black = false;  // all samples are black
  double load_seconds = 0, build_seconds = 0, write_seconds = 0;
  BvhReport trees;
  bool half = false;
};

nlohmann::json ToJson(const Plan& plan);
nlohmann::json ToJson(const ErrorEstimate& error);
/// Returns the members of a report that are known before the render; `scene`: its name.
nlohmann::json HeadJson(const Job& job, const std::string& scene, bool half);
/// Returns the whole report; `head` is of HeadJson.
nlohmann::json ToJson(const RenderReport& report, const nlohmann::json& head);

/// Returns the strategy that rendered the image: the job's, with the changes that its
/// trial run has made.
Strategy StrategyInForce(const RunResult& result, const Job& job);

/// Says how the sample points are randomised.
std::string PointsText(const Job& job);

/// Returns name, lanes and alternatives of a SIMD target.
nlohmann::json TargetJson(SimdTarget target);

}  // namespace lanelight
