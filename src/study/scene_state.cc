// What a study on one scene settles before its renders, and keeps for a continuation:
// sample counts, the reference, the diffuse models.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "kernels/simd/target.h"
#include "src/image/atomic_file.h"
#include "src/image/colors.h"
#include "src/study/scene_runner.h"
#include "src/study/schedule.h"

namespace lanelight {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr std::uint64_t kReferenceSeed = 0x9e3779b97f4a7c15u;

nlohmann::json ScatteringJson(const std::optional<Scattering>& scattering) {
  return scattering ? nlohmann::json(ScatteringName(*scattering)) : nlohmann::json();
}

// Everything that finished renders depend on, beyond their strategy.
nlohmann::json Identity(const StudyOptions& options, const Job& job) {
  const PixelRect& w = job.window;
  return {{"format", kFormat},
          {"scene_hash", fmt::format("{:016x}", job.scene_hash)},
          {"target", CurrentTarget()},
          {"resolution", {job.description.film.width, job.description.film.height}},
          {"crop", {w.x0, w.y0, w.x1, w.y1}},
          {"max_depth", job.plan.options.max_depth},
          {"seed", job.description.sampler.seed},
          {"scattering", ScatteringJson(options.settings.scattering)},
          {"references", options.references}};
}

}  // namespace

void SceneRunner::CheckState() {
  const std::string path = scene_.folder + "/cells/scene.json";
  const nlohmann::json identity = Identity(options_, job_);
  if (!fs::exists(path)) {
    state_ = {{"identity", identity}, {"counts", nlohmann::json::object()}};
    return SaveState();
  }
  try {
    state_ = nlohmann::json::parse(ReadWholeFile(path));
  } catch (const nlohmann::json::exception& error) {
    throw OtherStudy("'" + path + "' is damaged: " + error.what());
  }
  for (const auto& [name, value] : identity.items()) {
    const nlohmann::json& had = state_["identity"][name];
    if (had == value) continue;
    throw OtherStudy(fmt::format(
        "'{}' has a study with {} {}, and now it is {}: continue it with what it had, or "
        "give another directory",
        scene_.folder, name, had.dump(), value.dump()));
  }
}

void SceneRunner::SaveState() {
  WriteFileAtomically(scene_.folder + "/cells/scene.json", state_.dump(2) + "\n");
}

// Counts that were measured once stay: they depend on the machine's speed then.
void SceneRunner::FindCounts() {
  nlohmann::json& counts = state_["counts"];
  const bool given = !options_.spp.empty();
  bool all_known = true;
  for (StrategyRuns& runs : scene_.strategies) {
    if (runs.status != RunStatus::kOk) continue;
    all_known &= counts.contains(runs.Text());
  }
  if (given || !all_known) {
    Report("choosing sample counts");
    ChooseCounts(options_, job_, scene_.strategies);
  }
  for (StrategyRuns& runs : scene_.strategies) {
    if (runs.status != RunStatus::kOk) continue;
    if (!given && counts.contains(runs.Text())) {
      runs.counts = counts[runs.Text()].get<std::vector<std::uint64_t>>();
    }
    counts[runs.Text()] = runs.counts;
  }
  SaveState();
}

// The reference takes about half the samples of all strategies together at their largest
// count, so that its error is small next to theirs.
std::uint64_t SceneRunner::ReferenceSamples() const {
  std::uint64_t ok = 0;
  for (const StrategyRuns& runs : scene_.strategies) ok += runs.status == RunStatus::kOk;
  const std::uint64_t renders = ok * static_cast<std::uint64_t>(options_.Repetitions());
  return std::min(kMaxSpp, MostSamples() * std::max<std::uint64_t>(16, renders / 2));
}

void SceneRunner::PlanWork() {
  double work = 0;
  for (const StrategyRuns& runs : scene_.strategies) {
    for (std::uint64_t spp : runs.counts) {
      const auto done = store_->Load(runs.Text(), spp).repetitions.size();
      const auto wanted = static_cast<std::size_t>(options_.Repetitions());
      work += double(wanted - std::min(done, wanted)) * Work(spp);
    }
  }
  if (options_.references.empty() && !state_.contains("reference")) {
    work += Work(ReferenceSamples());
  }
  clock_.StartScene(work);
}

void SceneRunner::FindReference() {
  if (!options_.references.empty()) return;  // read already
  const std::string path = scene_.folder + "/reference.exr";
  if (state_.contains("reference")) {
    const nlohmann::json& had = state_["reference"];
    scene_.reference =
        ReadReference({path}, job_.window, scene_.full_width, scene_.full_height);
    scene_.reference.files.clear();
    scene_.reference.strategy = had.at("strategy");
    scene_.reference.spp = had.at("spp");
    scene_.reference.seconds = had.at("seconds");
    return;
  }
  const std::uint64_t spp = ReferenceSamples();
  const auto on_progress = [&](const Progress& p) {
    if (!hooks_.on_progress) return;
    const double own = Work(spp) * p.fraction;
    StudyClock ahead = clock_;
    ahead.Worked(own);
    hooks_.on_progress({scene_.name, fmt::format("reference, {} spp", spp),
                        ahead.Fraction(), ahead.Seconds(), ahead.SecondsLeft()});
  };
  scene_.reference =
      RenderReference(job_, spp, job_.description.sampler.seed ^ kReferenceSeed,
                      on_progress, hooks_.stop);
  clock_.Worked(Work(spp));
  if (Stopped()) return;
  WriteReference(path, scene_.reference);
  state_["reference"] = {{"strategy", scene_.reference.strategy},
                         {"spp", spp},
                         {"seconds", scene_.reference.seconds}};
  SaveState();
}

}  // namespace lanelight
