#include "src/cli/render_outputs.h"

#include <chrono>
#include <filesystem>
#include <functional>

#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/progress.h"
#include "src/cli/summary.h"
#include "src/cli/validators.h"
#include "src/core/error.h"
#include "src/image/atomic_file.h"
#include "src/image/png.h"
#include "src/render/output.h"
#include "src/render/report.h"
#include "src/estimate/estimate.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

// Writes through `write`; if that fails, into the temporary directory, so that nothing
// computed is lost. Replaces `path` by where the file is, or by nothing if nowhere.
bool Save(std::string& path, const std::function<void(const std::string&)>& write) {
  try {
    write(path);
    return true;
  } catch (const std::exception& error) {
    PrintError(error.what());
  }
  const std::string fallback = FallbackPath(path);
  path.clear();
  try {
    write(fallback);
    PrintError("the result is kept in '" + fallback + "'");
    path = fallback;
  } catch (const std::exception& error) {
    PrintError(std::string("nor could it be kept elsewhere: ") + error.what());
  }
  return false;
}

bool SaveImages(const RenderOutputs& options, const Job& job, const FilmAccumulator& film,
                RenderReport& report) {
  const auto start = std::chrono::steady_clock::now();
  report.exr = options.exr;
  bool good = Save(report.exr, [&](const std::string& path) {
    WriteExr(path, film.width(), film.height(), FilmPlanes(film, job.scene.scale),
             OutputOptions(job, report.result, report.half));
  });
  if (options.want_png) {
    report.png = options.png;
    good &= Save(report.png, [&](const std::string& path) {
      WritePng(path, FilmImage(film), options.exposure);
    });
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  report.write_seconds = taken.count();
  return good;
}

// Whether the image took the time that it should, and is as good as it should be.
int CheckAmount(const RenderReport& report, const Job& job, bool quiet) {
  const RunResult& r = report.result;
  if (!quiet && job.seconds > 0 && r.seconds > 1.05 * job.seconds &&
      r.samples <= 2 * job.window.pixels()) {
    PrintError(
        fmt::format("note: --time {}: one sample per pixel takes longer ({}); a lower "
                    "--resolution takes less",
                    job.seconds, DurationText(r.seconds)));
  }
  if (!job.target.Any() || Reached(job.target, report.error)) return kExitGood;
  const std::string limit = r.stop_reason == StopReason::kInterrupted ? "interruption"
                            : r.stop_reason == StopReason::kTime      ? "--time"
                                                                      : "--spp";
  PrintError(fmt::format("error: the target was not reached before the end by {}: {}",
                         limit, ErrorText(report.error)));
  return kExitTargetMissed;
}

}  // namespace

void AddOutputOptions(CLI::App& command, RenderOutputs& options, bool required) {
  command.add_option("-o,--output", options.exr, "Image to write (.exr)")
      ->required(required)
      ->check([](const std::string& path) {
        return fs::path(path).extension() == ".exr"
                   ? std::string()
                   : "'" + path + "' does not end in .exr (for a PNG add --png FILE)";
      })
      ->type_name("FILE");
  command.add_option("--depth", options.depth, "Type of colours in the EXR")
      ->check(CLI::IsMember({"half", "float"}).description(""))
      ->type_name("half|float");
  options.png_flag = command
                         .add_option("--png", options.png,
                                     "Write a PNG too; named after the EXR if bare")
                         ->expected(0, 1)
                         ->type_name("[FILE]");
  command.add_option("--exposure", options.exposure, "Exposure of the PNG in stops")
      ->check(FiniteRange(-100, 100))
      ->type_name("EV");
  command
      .add_option("--json", options.json, "Write a report for scripts ('-': print it)")
      ->type_name("FILE");
  command.add_flag("--quiet", options.quiet, "Print errors only");
}

void ResolvePng(RenderOutputs& options) {
  options.want_png = options.png_flag != nullptr && options.png_flag->count() > 0;
  if (!options.want_png) return;
  if (options.png.empty()) options.png = fs::path(options.exr).replace_extension(".png");
  if (fs::path(options.png).extension() == ".png") return;
  throw CLI::ValidationError("--png",
                             "'" + options.png +
                                 "' does not end in .png (SCENE must not follow a "
                                 "bare --png)");
}

void CheckOutputs(const RenderOutputs& options, const std::string& scene) {
  CheckOutputPaths({options.exr, options.want_png ? options.png : "", options.json},
                   scene);
}

void CheckOutputPaths(std::vector<std::string> paths, const std::string& scene) {
  std::erase_if(paths, [](const std::string& p) { return p.empty() || p == "-"; });
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::error_code error;
    if (fs::equivalent(paths[i], scene, error)) {
      throw InputError("output '" + paths[i] + "' would overwrite the scene");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (paths[i] == paths[j]) throw InputError("two outputs go to '" + paths[i] + "'");
    }
    CheckWritable(paths[i]);
  }
}

void PrintNotes(const Job& job) {
  constexpr std::size_t kShown = 8;
  const auto& notes = job.description.notes;
  for (std::size_t i = 0; i < notes.size() && i < kShown; ++i) {
    PrintError(notes[i].where.ToString() + ": note: " + notes[i].message);
  }
  if (notes.size() > kShown) {
    PrintError(
        fmt::format("and {} more notes (all are in --json)", notes.size() - kShown));
  }
  for (const std::string& note : job.plan.notes) PrintError("note: " + note);
}

bool SaveJson(const RenderOutputs& options, const nlohmann::json& report) {
  if (options.json.empty()) return true;
  return SaveText(options.json, report.dump(2) + "\n");
}

bool SaveText(const std::string& path, const std::string& text) {
  if (path.empty()) return true;
  if (path == "-") {
    Print(text);
    return true;
  }
  std::string where = path;
  return Save(where, [&](const std::string& p) { WriteFileAtomically(p, text); });
}

int RenderToOutputs(const RenderOutputs& options, const std::string& scene,
                    const Job& job, const std::atomic<bool>& stop,
                    const Preface& preface) {
  FilmAccumulator film = MakeFilm(job);
  ProgressPrinter progress(ChooseProgressStyle(options.quiet));
  RenderReport report;
  report.scene = scene;
  report.half = options.depth == "half";
  report.result =
      RunJob(job, film, [&](const Progress& p) { progress.Update(p); }, &stop);
  progress.Finish();
  report.error = EstimateError(film);

  bool good = SaveImages(options, job, film, report);
  nlohmann::json json = ToJson(report, job);
  json.update(preface.members);
  good &= SaveJson(options, json);
  if (!options.quiet && options.json != "-") {
    Print(preface.text + SummaryText(report, job));
  }
  if (report.result.health.Total() > 0) {
    PrintError(fmt::format("error: {} samples were invalid and count as zero",
                           report.result.health.Total()));
    return kExitInvalidSamples;
  }
  if (!good) return kExitBadInput;
  return CheckAmount(report, job, options.quiet);
}

}  // namespace lanelight
