#include "src/render/render.h"

#include <chrono>

#include "src/image/png.h"
#include "src/render/output.h"
#include "src/render/saving.h"

namespace lanelight {
namespace {

void SaveImages(const Job& job, const FilmAccumulator& film, const RenderTargets& targets,
                Saver& saver, RenderReport& report) {
  const auto start = std::chrono::steady_clock::now();
  report.exr = targets.exr;
  saver.Save(report.exr, [&](const std::string& path) {
    WriteExr(path, film.width(), film.height(), FilmPlanes(film, job.scene.scale),
             OutputOptions(job, report.result, report.half));
  });
  report.png = targets.png;
  saver.Save(report.png, [&](const std::string& path) {
    WritePng(path, FilmImage(film), targets.exposure);
  });
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  report.write_seconds = taken.count();
}

}  // namespace

Rendering RenderToFiles(const Job& job, const std::string& scene,
                        const RenderTargets& targets, const RenderHooks& hooks) {
  FilmAccumulator film = MakeFilm(job);
  RunOptions options = RunOptionsOf(job, film);
  options.on_progress = hooks.on_progress;
  options.stop = hooks.stop;

  Rendering out;
  RenderReport& report = out.report;
  report.scene = scene;
  report.half = targets.half;
  report.result = Run(job.scene, job.plan, options, film);
  report.error = EstimateError(film);
  if (hooks.on_rendered) hooks.on_rendered();

  Saver saver;
  SaveImages(job, film, targets, saver, report);
  if (!targets.json.empty()) {
    nlohmann::json json = ToJson(report, job);
    json.update(hooks.members);
    out.json = json.dump(2) + "\n";
  }
  if (targets.json != "-") saver.SaveText(targets.json, out.json);
  out.problems = saver.problems();
  return out;
}

}  // namespace lanelight
