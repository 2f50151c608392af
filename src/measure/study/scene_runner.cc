#include "src/measure/study/scene_runner.h"

#include <filesystem>

#include "kernels/simd/target.h"
#include "src/measure/study/reference.h"
#include "src/render/estimate/estimate.h"
#include "src/render/films/colors.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/saving.h"
#include "src/render/wave/profile.h"
#include "src/scene/description/note.h"

namespace lanelight {
namespace {

std::string CellKey(const StrategyRuns& runs, std::uint64_t spp) {
  return fmt::format("{} {}", runs.Text(), spp);
}

void Describe(const RunResult& result, const ErrorEstimate& self, Measurement& m) {
  m.samples = result.samples;
  m.wall_seconds = result.seconds;
  m.cpu_seconds = result.cpu_seconds;
  m.pilot_seconds = result.training.seconds;
  m.rays_closest = result.rays_closest;
  m.rays_shadow = result.rays_shadow;
  m.invalid = result.health.Total();
  if (!self.available) return;
  m.self_relmse = self.relmse.value;
  if (!self.relmse.HasBounds()) return;
  m.self_low = self.relmse.low;
  m.self_high = self.relmse.high;
}

}  // namespace

SceneRunner::SceneRunner(const StudyOptions& options, const StudyHooks& hooks,
                         StudyClock& clock, SceneRuns& scene)
    : options_(options), hooks_(hooks), clock_(clock), scene_(scene) {}

void SceneRunner::Run() {
  Prepare();
  CheckStrategies();
  ChooseCountsAndReference();
  if (!IsStopped()) RunCells();
  if (!IsStopped() && options_.paper) RunDiffuseModels();
  scene_.interrupted = IsStopped();
  if (!IsStopped()) Report("finished");
}

// Chooses sample counts and the reference. One process does it; the others wait and use
// its results.
void SceneRunner::ChooseCountsAndReference() {
  const auto claim = WaitForClaim("scene");
  if (!claim) return;
  CheckState();
  FindCounts();
  if (IsStopped()) return;
  PlanWork();
  FindReference();
}

void SceneRunner::Prepare() {
  Report("reading and building");
  RenderSettings settings = options_.settings;
  settings.spp = 1;
  for (const NamedStrategy& named : StudyStrategies(options_, {})) {
    settings.compared.push_back(named.strategy);
  }
  job_ = PrepareJob(scene_.path, settings);
  CheckOutputPaths({OutputFiles(options_), {scene_.folder}}, job_.loaded->files);
  scene_.hash = fmt::format("{:016x}", job_.loaded->scene_hash);
  scene_.full_width = job_.loaded->description.film.width;
  scene_.full_height = job_.loaded->description.film.height;
  scene_.window = job_.window;
  scene_.load_seconds = job_.loaded->load_seconds;
  scene_.build_seconds = job_.loaded->build_seconds;
  scene_.trees = job_.loaded->trees;
  for (const Note& note : job_.loaded->description.notes) {
    scene_.notes.push_back(note.where.ToString() + ": " + note.message);
  }
  scene_.differs = ImageChangesText(job_.loaded->description.notes);
  // Reads references before writing anything, so that an invalid file has no effect.
  if (!options_.references.empty()) {
    scene_.reference = ReadReference(options_.references, job_.window, scene_.full_width,
                                     scene_.full_height);
  }
  store_ = std::make_unique<CellStore>(scene_.folder + "/cells", job_.window);
  claims_ = std::make_unique<LockFile>(scene_.folder + "/cells/claims");
}

std::uint64_t SceneRunner::Seed(int repetition) const {
  return job_.loaded->description.sampler.seed + 1 + std::uint64_t(repetition);
}

std::uint64_t SceneRunner::MaxSamples() const {
  std::uint64_t max_spp = 1;
  for (const StrategyRuns& runs : scene_.strategies) {
    if (!runs.counts.empty()) max_spp = std::max(max_spp, runs.counts.back());
  }
  return max_spp;
}

double SceneRunner::Work(std::uint64_t spp) const {
  // The start of a render costs about as much as 5000 samples.
  return double(spp) * double(job_.window.pixels()) + 5000;
}

bool SceneRunner::IsStopped() const { return hooks_.stop != nullptr && *hooks_.stop; }

std::optional<ScopedLock> SceneRunner::WaitForClaim(const std::string& name) const {
  return claims_->Wait(name, [this](double) { return !IsStopped(); });
}

void SceneRunner::Report(const std::string& what) {
  if (!hooks_.on_progress) return;
  hooks_.on_progress(
      {scene_.name, what, clock_.Fraction(), clock_.Seconds(), clock_.SecondsLeft()});
}

void SceneRunner::RunCells() {
  std::set<std::uint64_t> counts;
  for (const StrategyRuns& runs : scene_.strategies) {
    counts.insert(runs.counts.begin(), runs.counts.end());
  }
  for (int repetition = 0; repetition < options_.Repetitions(); ++repetition) {
    for (std::uint64_t spp : counts) {
      for (StrategyRuns& runs : scene_.strategies) {
        if (!std::binary_search(runs.counts.begin(), runs.counts.end(), spp)) continue;
        if (runs.status != RunStatus::kOk) continue;
        if (!RunRepetition(runs, spp, repetition)) return;
      }
    }
  }
  WaitForOthers();
}

// Returns false if stopped.
bool SceneRunner::RunRepetition(StrategyRuns& runs, std::uint64_t spp, int repetition) {
  const auto claim = claims_->TryLock(CellKey(runs, spp));
  if (!claim) {
    elsewhere_.insert({&runs, spp});
    return true;
  }
  return FillCell(runs, spp, repetition);
}

// Waits for cells of other processes, and renders them if those processes died.
void SceneRunner::WaitForOthers() {
  for (const auto& [runs, spp] : elsewhere_) {
    Report(fmt::format("waiting for {}, {} spp", runs->named.name, spp));
    const auto claim = WaitForClaim(CellKey(*runs, spp));
    if (!claim || !FillCell(*runs, spp, options_.Repetitions() - 1)) return;
  }
}

// Renders missing repetitions up to this one. Returns false if stopped.
bool SceneRunner::FillCell(StrategyRuns& runs, std::uint64_t spp, int repetition) {
  Cells cells = store_->Load(runs.Text(), spp);
  const int done = int(cells.repetitions.size());
  for (int next = done; next <= repetition && runs.status == RunStatus::kOk; ++next) {
    if (!RenderRepetition(runs, spp, next, cells)) return false;
  }
  return true;
}

bool SceneRunner::RenderRepetition(StrategyRuns& runs, std::uint64_t spp, int repetition,
                                   Cells& cells) {
  const std::string cell =
      fmt::format("{}, {} spp, repetition {}", runs.named.name, spp, repetition + 1);
  Report(cell);
  try {
    cells.repetitions.push_back(Render(runs, spp, repetition, cells));
    if (IsStopped()) return false;
    store_->Save(runs.Text(), spp, cells);
  } catch (const std::bad_alloc&) {
    runs.message = cell + ": out of memory";
    runs.status = RunStatus::kFailed;
  } catch (const std::exception& error) {
    runs.message = cell + ": " + error.what();
    runs.status = RunStatus::kFailed;
  }
  if (runs.status == RunStatus::kFailed && hooks_.on_problem) {
    hooks_.on_problem(scene_.name + ": " + runs.message);
  }
  clock_.AddDoneWork(Work(spp));
  return true;
}

Measurement SceneRunner::Render(const StrategyRuns& runs, std::uint64_t spp,
                                int repetition, Cells& cells) {
  const Job job = WithRender(job_, runs.named.strategy, spp, Seed(repetition));
  const JobRun run = RunJob(job, {}, hooks_.stop);
  Measurement m;
  m.machine = ThisMachine();
  m.seed = job.seed;
  if (IsStopped()) return m;
  Describe(run.result, EstimateError(run.film), m);
  const std::vector<Rgb> image = FilmColors(run.film);
  MeasureErrors(image, scene_.reference, m);
  m.worst_x += std::uint64_t(scene_.window.x0);
  m.worst_y += std::uint64_t(scene_.window.y0);
  cells.moments.Add(image);
  AddStages(run.result.stages, cells.stages);
  if (repetition == 0) cells.first = image;
  return m;
}

}  // namespace lanelight
