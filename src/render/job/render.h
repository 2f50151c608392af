// A render from a job to its files.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/base/core/connection.h"
#include "src/render/job/checkpoint.h"
#include "src/render/job/error_so_far.h"
#include "src/render/job/job.h"
#include "src/render/job/report.h"

namespace lanelight {

/// Destinations of results; an empty path means none.
struct RenderTargets {
  std::string exr, png;
  std::string json;  // "-": only into Rendering::json
  ImageSettings image;
  CheckpointSettings checkpoint;
  std::optional<Endpoint> display;  // a viewer that shows the image so far
  /// A render that ends early replaces an earlier image of the same render only.
  bool keeps_others = true;
};

struct RenderHooks {
  std::function<void(const RenderProgress&)> on_progress;
  bool reports_error = false;  // progress has the error so far, which costs a little
  std::function<void()> on_training;  // RunOptions
  std::function<void()> on_rendered;  // before anything is written
  /// Receives problems with states, watched images or the viewer; from any thread.
  std::function<void(const std::string&)> on_problem;
  RankGroup* group = nullptr;               // who renders; null: this process alone
  const std::atomic<bool>* stop = nullptr;  // ends the render early; what is there counts
};

struct Rendering {
  RenderReport report;
  nlohmann::json json;                // the report, if the targets have one
  std::vector<std::string> problems;  // of writing; see ResultWriter
  bool is_checkpoint_saved = false;   // the last state is on the disk
};

/// Renders the job, estimates the error, and writes images and report; `scene`: name of
/// the scene in the report. What cannot be written is kept in the temporary directory. An
/// image with pixels without samples goes to PartialTargets(), and so does one of a
/// render that ended early if it would replace another file. With a checkpoint the state
/// is kept, and the render may resume. Throws InputError for a state that it cannot
/// resume.
Rendering RenderToFiles(const Job& job, const std::string& scene,
                        const RenderTargets& targets, const RenderHooks& hooks);

/// Renders as a worker (src/base/core/rank_group.h): writes nothing.
void ServeRender(const Job& job, RankGroup& group, const std::atomic<bool>* stop);

/// Facts about the render of a film.
struct RenderFacts {
  nlohmann::json identity, head;  // src/render/job/identity.h, HeadJson
  double scale = 1;               // CompiledScene::scale
  std::string color_space;        // that the film holds (src/base/image/color_spaces.h)
  /// Pixels that should have samples: all of the film, or those of a part. Images with
  /// fewer go to PartialTargets(), unless `partial` is set.
  std::uint64_t pixels = 0;
  bool partial = false;
};

/// Estimates the error and writes images and report of any film; out.report.result is its
/// result. `members`: further members of the report.
void WriteRendering(const FilmAccumulator& film, const RenderFacts& facts,
                    const RenderTargets& targets, const nlohmann::json& members,
                    Rendering& out);

}  // namespace lanelight
