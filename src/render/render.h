// A render from a job to its files.
#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/render/job.h"
#include "src/render/report.h"

namespace lanelight {

/// Where results go; an empty path: nowhere.
struct RenderTargets {
  std::string exr, png;
  std::string json;     // "-": only into Rendering::json
  double exposure = 0;  // of the PNG, stops
  bool half = false;    // colours of the EXR in 16 bits
};

struct RenderHooks {
  std::function<void(const Progress&)> on_progress;
  std::function<void()> on_rendered;        // before anything is written
  const std::atomic<bool>* stop = nullptr;  // ends the render early; what is there counts
  nlohmann::json members = nlohmann::json::object();  // of the report, beside its own
};

struct Rendering {
  RenderReport report;
  std::string json;                   // the report as text
  std::vector<std::string> problems;  // of writing; see Saver
};

/// Renders the job, estimates the error, and writes images and report; `scene`: name of
/// the scene in the report. What cannot be written where it should is kept elsewhere.
Rendering RenderToFiles(const Job& job, const std::string& scene,
                        const RenderTargets& targets, const RenderHooks& hooks);

}  // namespace lanelight
