// Sample counts and reference of a study on one scene, which are kept when it is resumed,
// and the clock.

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/core/input_file.h"
#include "src/base/core/json_text.h"
#include "src/base/image/atomic_file.h"
#include "src/measure/study/scene_runner.h"
#include "src/render/films/colors.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/job/setting.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

constexpr int kSceneFormat = 1;
constexpr std::uint64_t kReferenceSeed = 0x9e3779b97f4a7c15u;

// Returns all settings that finished renders depend on, other than their strategy.
nlohmann::json Identity(const StudyOptions& options, const Job& job) {
  RenderSettings settings = SettingsInForce(job);
  settings.seed =
      job.loaded->description.sampler.seed;  // repetitions have seeds of their own
  nlohmann::json identity = SettingsJson(settings, kStudyIdentity);
  identity.update({{"format", kSceneFormat},
                   {"scene_hash", fmt::format("{:016x}", job.loaded->scene_hash)},
                   {"references", options.references}});
  return identity;
}

}  // namespace

void SceneRunner::CheckState() {
  const std::string path = scene_.folder + "/cells/scene.json";
  // Converts to text and back, since names of references may have bytes that are not
  // UTF-8.
  const nlohmann::json identity = ParseJson(DumpJson(Identity(options_, job_)));
  if (!fs::exists(path)) {
    state_ = {{"identity", identity}, {"counts", nlohmann::json::object()}};
    return SaveState();
  }
  state_ = ParseJson(ReadWholeFile(path));
  for (const auto& [name, value] : identity.items()) {
    const nlohmann::json& had = state_["identity"][name];
    if (had == value) continue;
    throw OtherStudy(
        "'{}' has a study with {} {}, but now it is {}; continue it with the "
        "same value, or "
        "use another directory",
        scene_.folder, name, DumpJson(had), DumpJson(value));
  }
}

void SceneRunner::SaveState() {
  WriteFileAtomically(scene_.folder + "/cells/scene.json", DumpJson(state_, 2) + "\n");
}

// Finds sample counts. Measured counts are kept, since they depend on the machine's
// speed.
void SceneRunner::FindCounts() {
  nlohmann::json& counts = state_["counts"];
  nlohmann::json& deviations = state_["spreads"];
  if (deviations.is_null()) deviations = nlohmann::json::object();
  const bool has_counts = !options_.spp.empty();
  bool all_known = true;
  for (StrategyRuns& runs : scene_.strategies) {
    if (runs.status != RunStatus::kOk) continue;
    all_known &= counts.contains(runs.Text());
  }
  if (has_counts || !all_known) {
    Report("choosing sample counts");
    ChooseCounts(options_, job_, scene_.strategies, hooks_.stop);
  }
  for (StrategyRuns& runs : scene_.strategies) {
    if (runs.status != RunStatus::kOk) continue;
    if (!has_counts && counts.contains(runs.Text())) {
      runs.counts = counts[runs.Text()].get<std::vector<std::uint64_t>>();
      runs.count_deviation = deviations.value(runs.Text(), 0.0);
    }
    if (runs.counts.empty()) continue;  // stopped before they were known
    counts[runs.Text()] = runs.counts;
    if (runs.count_deviation > 0) deviations[runs.Text()] = runs.count_deviation;
  }
  SaveState();
}

// Returns about half the samples of all strategies together at their largest count, so
// that the reference's error is much smaller than theirs.
std::uint64_t SceneRunner::ReferenceSamples() const {
  std::uint64_t ok = 0;
  for (const StrategyRuns& runs : scene_.strategies) ok += runs.status == RunStatus::kOk;
  const std::uint64_t renders = ok * std::uint64_t(options_.Repetitions());
  return std::min(kMaxSpp, MaxSamples() * std::max<std::uint64_t>(16, renders / 2));
}

void SceneRunner::PlanWork() {
  double work = 0;
  for (const StrategyRuns& runs : scene_.strategies) {
    for (std::uint64_t spp : runs.counts) {
      const auto done = store_->Load(runs.Text(), spp).repetitions.size();
      const auto wanted = std::size_t(options_.Repetitions());
      work += double(wanted - std::min(done, wanted)) * Work(spp);
    }
  }
  if (options_.references.empty() && !state_.contains("reference")) {
    work += Work(state_.value("reference_spp", ReferenceSamples()));
  }
  clock_.StartScene(work);
}

std::string SceneRunner::ReferencePath() const {
  return scene_.folder + "/reference.exr";
}

void SceneRunner::LoadReference() {
  const nlohmann::json& had = state_["reference"];
  try {
    scene_.reference = ReadReference({ReferencePath()}, job_.window, scene_.full_width,
                                     scene_.full_height);
  } catch (const InputError& error) {
    throw InputError(
        "the reference of this study cannot be read: {}\nremove '{}', and use --resume "
        "to render it again ({} samples per pixel)",
        error.what(), ReferencePath(), had.at("spp").get<std::uint64_t>());
  }
  scene_.reference.files.clear();
  scene_.reference.strategy = had.at("strategy");
  scene_.reference.spp = had.at("spp");
  scene_.reference.seconds = had.at("seconds");
}

// Reads or renders the reference. A resumed study keeps its sample count, since errors
// were measured against it.
void SceneRunner::FindReference() {
  if (!options_.references.empty()) return;  // read already
  if (state_.contains("reference") && fs::exists(ReferencePath())) return LoadReference();
  ReferenceOptions options;
  options.spp = state_.value("reference_spp", ReferenceSamples());
  if (state_.contains("reference")) options.spp = state_["reference"].at("spp");
  options.seed = job_.loaded->description.sampler.seed ^ kReferenceSeed;
  options.state = scene_.folder + "/cells/reference.state";
  options.on_problem = hooks_.on_problem;
  options.stop = hooks_.stop;
  options.on_progress = [&](const Progress& p) {
    if (!hooks_.on_progress) return;
    StudyClock ahead = clock_;
    ahead.AddDoneWork(Work(options.spp) * p.fraction);
    hooks_.on_progress({scene_.name, fmt::format("reference, {} spp", options.spp),
                        ahead.Fraction(), ahead.Seconds(), ahead.SecondsLeft()});
  };
  state_["reference_spp"] = options.spp;
  SaveState();
  scene_.reference = RenderReference(job_, options);
  clock_.AddDoneWork(Work(options.spp));
  if (IsStopped()) return;
  WriteReference(ReferencePath(), scene_.reference);
  state_["reference"] = {{"strategy", scene_.reference.strategy},
                         {"spp", options.spp},
                         {"seconds", scene_.reference.seconds}};
  SaveState();
  fs::remove(options.state);
}

void StudyClock::StartScene(double work) {
  started_ = true;
  --scenes_left_;
  ++scenes_started_;
  planned_ += work;
}

void StudyClock::FinishScene() {
  if (!started_) --scenes_left_;  // failed before its work was known
  started_ = false;
}

double StudyClock::Total() const {
  if (scenes_started_ == 0) return 0;
  return planned_ * (1 + double(scenes_left_) / double(scenes_started_));
}

double StudyClock::Fraction() const {
  return Total() > 0 ? std::clamp(done_ / Total(), 0.0, 1.0) : 0;
}

double StudyClock::SecondsLeft() const {
  const double fraction = Fraction();
  return fraction > 0 ? Seconds() * (1 - fraction) / fraction : 0;
}

}  // namespace lanelight
