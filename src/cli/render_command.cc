// `lanelight render SCENE`: the flags, and the render from start to end.
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>

#include "kernels/simd/target.h"
#include "src/cli/commands.h"
#include "src/cli/console.h"
#include "src/cli/exit_codes.h"
#include "src/cli/interrupt.h"
#include "src/cli/progress.h"
#include "src/cli/scene_options.h"
#include "src/cli/summary.h"
#include "src/cli/validators.h"
#include "src/core/error.h"
#include "src/core/parallel.h"
#include "src/image/atomic_file.h"
#include "src/image/png.h"
#include "src/render/output.h"
#include "src/render/report.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

struct RenderCommandOptions {
  SceneOptions scene;
  std::string exr, png, json, depth = "float";
  double exposure = 0;
  bool want_png = false, quiet = false;
};

void CheckOutputs(const RenderCommandOptions& options) {
  std::vector<std::string> paths = {options.exr};
  if (options.want_png) paths.push_back(options.png);
  if (!options.json.empty() && options.json != "-") paths.push_back(options.json);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::error_code error;
    if (fs::equivalent(paths[i], options.scene.scene, error)) {
      throw InputError("output '" + paths[i] + "' would overwrite the scene");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (paths[i] == paths[j]) throw InputError("two outputs go to '" + paths[i] + "'");
    }
    CheckWritable(paths[i]);
  }
}

void PrintNotes(const SceneDescription& description) {
  constexpr std::size_t kShown = 8;
  const auto& notes = description.notes;
  for (std::size_t i = 0; i < notes.size() && i < kShown; ++i) {
    PrintError(notes[i].where.ToString() + ": note: " + notes[i].message);
  }
  if (notes.size() > kShown) {
    PrintError(
        fmt::format("and {} more notes (all are in --json)", notes.size() - kShown));
  }
}

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

bool SaveImages(const RenderCommandOptions& options, const Job& job,
                const FilmAccumulator& film, RenderReport& report) {
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

bool SaveJson(const RenderCommandOptions& options, const RenderReport& report,
              const Job& job) {
  if (options.json.empty()) return true;
  const std::string text = ToJson(report, job).dump(2) + "\n";
  if (options.json == "-") {
    Print(text);
    return true;
  }
  std::string path = options.json;
  return Save(path, [&](const std::string& p) { WriteFileAtomically(p, text); });
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

int Render(const RenderCommandOptions& options) {
  ForceTarget(options.scene.target);
  const ThreadLimit threads(options.scene.threads);
  CheckOutputs(options);
  const Job job = PrepareJob(options.scene.scene, options.scene.settings);
  if (!options.quiet) PrintNotes(job.description);
  if (!options.quiet) {
    for (const std::string& note : job.plan.notes) PrintError("note: " + note);
  }

  FilmAccumulator film = MakeFilm(job);
  ProgressPrinter progress(ChooseProgressStyle(options.quiet));
  const InterruptGuard interrupt;
  RenderReport report;
  report.scene = options.scene.scene;
  report.half = options.depth == "half";
  report.result = RunJob(
      job, film, [&](const Progress& p) { progress.Update(p); }, &interrupt.stop());
  progress.Finish();
  report.error = EstimateError(film);

  bool good = SaveImages(options, job, film, report);
  good &= SaveJson(options, report, job);
  if (!options.quiet && options.json != "-") Print(SummaryText(report, job));
  if (report.result.health.Total() > 0) {
    PrintError(fmt::format("error: {} samples were invalid and count as zero",
                           report.result.health.Total()));
    return kExitInvalidSamples;
  }
  if (!good) return kExitBadInput;
  return CheckAmount(report, job, options.quiet);
}

// "--png" alone names the file after the EXR. A word after it that is no PNG is most
// likely the scene, swallowed.
void ResolvePng(const CLI::Option& option, RenderCommandOptions& options) {
  options.want_png = option.count() > 0;
  if (!options.want_png) return;
  if (options.png.empty()) options.png = fs::path(options.exr).replace_extension(".png");
  if (fs::path(options.png).extension() == ".png") return;
  throw CLI::ValidationError("--png",
                             "'" + options.png +
                                 "' does not end in .png (SCENE must not follow a "
                                 "bare --png)");
}

CLI::Option* AddOutputOptions(CLI::App& command, RenderCommandOptions& options) {
  command.add_option("-o,--output", options.exr, "Image to write (.exr)")
      ->required()
      ->check([](const std::string& path) {
        return fs::path(path).extension() == ".exr"
                   ? std::string()
                   : "'" + path + "' does not end in .exr (for a PNG add --png FILE)";
      })
      ->type_name("FILE");
  command.add_option("--depth", options.depth, "Colour in the EXR: half or float")
      ->check(CLI::IsMember({"half", "float"}).description(""))
      ->type_name("TYPE");
  CLI::Option* png = command
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
  return png;
}

void AddTargetOption(CLI::App& command, const char* name, const char* meaning,
                     std::optional<double>& target) {
  command.add_option(name, target, meaning)
      ->check(FiniteRange(1e-12, 1e12))
      ->type_name("X");
}

void AddAmountOptions(CLI::App& command, RenderSettings& settings) {
  command.add_option("--spp", settings.spp, "Samples per pixel")
      ->check(CLI::Range(std::uint64_t{1}, kMaxSpp).description(""))
      ->type_name("N");
  command.add_option("--time", settings.seconds, "Render for this many seconds instead")
      ->check(FiniteRange(1e-3, 1e9))
      ->type_name("SECONDS");
  AddTargetOption(command, "--target-relmse",
                  "Stop once the relative MSE is below X, at 95 % confidence; --spp and "
                  "--time then are the most it may take",
                  settings.target_relmse);
  AddTargetOption(command, "--target-rmse", "The same for the RMSE",
                  settings.target_rmse);
  command.add_option("--seed", settings.seed, "Seed of the random numbers")
      ->type_name("S");
}

// Without a target both would say how much to render.
void CheckAmountOptions(const RenderSettings& settings) {
  if (!settings.spp || !settings.seconds || HasTarget(settings)) return;
  throw CLI::ValidationError(
      "--time",
      "--time excludes --spp, except as limits of --target-relmse or "
      "--target-rmse");
}

}  // namespace

void AddRenderCommand(CLI::App& root, int& exit_code) {
  CLI::App* command = root.add_subcommand("render", "Render a scene to an OpenEXR image");
  auto options = std::make_shared<RenderCommandOptions>();
  AddAmountOptions(*command, options->scene.settings);
  CLI::Option* png = AddOutputOptions(*command, *options);
  AddSceneOptions(*command, options->scene);
  command->footer(
      "\nFlags override what the scene file says. Ctrl-C finishes the samples in flight "
      "and\n"
      "writes the image; a second one aborts.\n"
      "\nExamples:\n"
      "  lanelight render scene.pbrt -o out.exr --spp 256 --png\n"
      "  lanelight render scene.pbrt -o out.exr --time 60 --resolution 640x360 --json "
      "r.json\n"
      "  lanelight render scene.pbrt -o out.exr --target-relmse 0.001 --time 600\n"
      "  lanelight render scene.pbrt -o part.exr --crop 100,100,200,150 --aov");
  command->callback([options, png, &exit_code] {
    ResolvePng(*png, *options);
    CheckAmountOptions(options->scene.settings);
    exit_code = Render(*options);
  });
}

}  // namespace lanelight
