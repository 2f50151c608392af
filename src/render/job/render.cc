#include "src/render/job/render.h"

#include <memory>
#include <optional>

#include "src/base/core/error.h"
#include "src/base/core/json_text.h"
#include "src/base/core/parallel.h"
#include "src/base/core/stopwatch.h"
#include "src/base/image/image.h"
#include "src/render/films/accumulator.h"
#include "src/render/job/display.h"
#include "src/render/job/identity.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/output.h"
#include "src/render/job/partial_outputs.h"
#include "src/render/job/saving.h"
#include "src/render/wave/tiles.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

void AddProblems(const ResultWriter& writer, Rendering& out) {
  const std::vector<std::string>& problems = writer.problems();
  out.problems.insert(out.problems.end(), problems.begin(), problems.end());
}

void SaveImages(const FilmAccumulator& film, const RenderFacts& facts,
                const RenderTargets& targets, const ExrOptions& options, Rendering& out) {
  const Stopwatch watch;
  ResultWriter writer;
  RenderReport& report = out.report;
  report.exr = targets.exr;
  writer.Save(report.exr, [&](const std::string& path) {
    WriteExr(path, film.width(), film.height(), FilmPlanes(film, facts.scale), options);
  });
  report.png = targets.png;
  writer.Save(report.png, [&](const std::string& path) {
    WritePng(path, FilmImage(film, facts.color_space), targets.image.exposure);
  });
  report.write_seconds = watch.Seconds();
  AddProblems(writer, out);
}

void SaveReport(const RenderFacts& facts, const RenderTargets& targets,
                const Json& members, Rendering& out) {
  if (!targets.json.empty()) {
    out.json = ToJson(out.report, facts.head);
    out.json.update(members);
  }
  if (targets.json == "-") return;
  ResultWriter writer;
  writer.SaveText(targets.json, DumpJson(out.json, 2) + "\n");
  AddProblems(writer, out);
}

// Every sample is black; false without samples.
bool IsBlack(const FilmAccumulator& film) {
  bool black = true, sampled = false;
  ForEachPixel(film, [&](int x, int y) {
    sampled |= film.Samples(x, y) > 0;
    black &= film.Mean(x, y) == Rgb{};
  });
  return black && sampled;
}

// Chooses files so that no image replaces one with more samples.
RenderTargets ChooseTargets(RenderTargets targets, const ExrOptions& image,
                            RenderReport& report) {
  const StopReason reason = report.result.stop_reason;
  const bool early =
      reason == StopReason::kInterrupted || reason == StopReason::kHopeless;
  if (report.has_holes && report.result.samples == 0) targets.exr = targets.png = "";
  if (report.has_holes || (early && targets.keeps_others)) {
    report.partial_number =
        FreePartialNumber(targets, image, /*first=*/report.has_holes ? 1 : 0);
  }
  return PartialTargets(targets, report.partial_number);
}

// Throws InputError if a rank would render something else.
void AgreeOnJob(const Job& job, RankGroup& group) {
  const std::string own = DumpJson(IdentityOf(job));
  group.Gather(own, [&](int rank, std::string_view its) {
    const std::string differs =
        IdentityDifferences(ParseJson(own), "rank 0", ParseJson(std::string(its)), "it");
    if (differs.empty()) return;
    throw InputError(
        fmt::format("{} has a different render:{}", group.Name(rank), differs));
  });
}

// Keeps the state after the failure of a rank, and tells the user.
[[noreturn]] void ReportRankFailure(const RankFailure& failure,
                                    const CheckpointSettings& settings,
                                    Checkpoint& checkpoint) {
  checkpoint.Finish();
  if (settings.path.empty() || !checkpoint.kept()) throw failure;
  throw RankFailure(fmt::format("{}\nthe state was saved: continue with --resume '{}'",
                                failure.what(), settings.path));
}

Display::OnProblem Problems(const RenderHooks& hooks) {
  return [&hooks](const std::string& problem) {
    if (hooks.on_problem) hooks.on_problem(problem);
  };
}

// Options of a run whose progress is printed or shown in a viewer.
struct ShownRun {
  ShownRun(const Job& job, const RenderTargets& targets, const RenderHooks& hooks,
           const FilmAccumulator& film, const std::string& scene)
      : options(RunOptionsOf(job)), error(job.target) {
    options.stop = hooks.stop;
    options.group = hooks.group;
    options.on_training = hooks.on_training;
    if (hooks.on_progress) {
      if (hooks.reports_error) error.Listen(job.window.pixels(), options);
      options.on_progress = [&](const Progress& p) { hooks.on_progress(error.At(p)); };
    }
    if (!targets.display) return;
    display.emplace(*targets.display, targets.exr.empty() ? scene : targets.exr, film,
                    job.loaded->description.film.color_space, Problems(hooks));
    options.on_tile = [&](const FilmAccumulator& so_far, const PixelRect& place) {
      display->Changed(so_far, place);
    };
  }
  // Its options refer to it.
  ShownRun(const ShownRun&) = delete;
  ShownRun& operator=(const ShownRun&) = delete;

  RunOptions options;
  ErrorSoFar error;
  std::optional<Display> display;
};

}  // namespace

Rendering RenderToFiles(const Job& job, const std::string& scene,
                        const RenderTargets& targets, const RenderHooks& hooks) {
  const ThreadLimit threads(job.settings.threads);
  RenderFacts facts;
  facts.identity = IdentityOf(job);
  facts.head = HeadJson(job, scene, targets.image.half);
  facts.scale = job.scene.scale();
  facts.color_space = job.loaded->description.film.color_space;
  Rendering out;
  out.report.scene = scene;
  out.report.half = targets.image.half;
  out.report.load_seconds = job.loaded->load_seconds;
  out.report.build_seconds = job.loaded->build_seconds;
  out.report.trees = job.loaded->trees;
  FilmAccumulator film = MakeFilm(job);
  ShownRun shown(job, targets, hooks, film, scene);
  std::optional<Checkpoint> checkpoint;
  if (targets.checkpoint.Any()) {
    checkpoint.emplace(job, targets.checkpoint, facts.head, Problems(hooks));
    shown.options.tiles = checkpoint->tiles();
    shown.options.checkpointer = &*checkpoint;
  }
  // A part shows the pixels of its tiles only.
  const std::vector<PixelRect>& tiles = shown.options.tiles;
  facts.pixels = tiles.empty() ? job.window.pixels() : PixelsOf(tiles);
  if (hooks.group != nullptr) AgreeOnJob(job, *hooks.group);
  try {
    out.report.result = Run(job.scene, job.plan, shown.options, film);
  } catch (const RankFailure& failure) {
    if (checkpoint) ReportRankFailure(failure, targets.checkpoint, *checkpoint);
    throw;
  }
  if (checkpoint) {
    out.problems = checkpoint->Finish();
    out.is_checkpoint_saved = checkpoint->kept();
  }
  if (shown.display) shown.display->Finish(film);
  if (hooks.on_rendered) hooks.on_rendered();
  WriteRendering(film, facts, targets, Json::object(), out);
  return out;
}

void ServeRender(const Job& job, RankGroup& group, const std::atomic<bool>* stop) {
  FilmAccumulator film = MakeFilm(job);
  RunOptions options = RunOptionsOf(job);
  options.stop = stop;
  options.group = &group;
  AgreeOnJob(job, group);
  ServeRun(job.scene, job.plan, options, film);
}

void WriteRendering(const FilmAccumulator& film, const RenderFacts& facts,
                    const RenderTargets& requested, const Json& members, Rendering& out) {
  const std::uint64_t sampled = SampledPixels(film);
  out.report.unsampled_pixels =
      std::uint64_t(film.width()) * std::uint64_t(film.height()) - sampled;
  out.report.has_holes = sampled < facts.pixels && !facts.partial;
  if (sampled >= facts.pixels) {
    out.report.error = EstimateError(film);
  } else {
    out.report.error.why =
        fmt::format("{} pixels have no sample", facts.pixels - sampled);
  }
  out.report.black = IsBlack(film);
  const RunResult& result = out.report.result;
  const ExrOptions options = OutputOptions(
      facts.identity, facts.head, {result, result.training.changes, out.report.error},
      film, requested.image.half);
  const RenderTargets targets = ChooseTargets(requested, options, out.report);
  SaveImages(film, facts, targets, options, out);
  SaveReport(facts, targets, members, out);
}

}  // namespace lanelight
