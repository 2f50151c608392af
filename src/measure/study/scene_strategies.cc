// Which strategies of a study a scene takes, and which of them are one on it.
#include <algorithm>

#include "src/measure/study/scene_runner.h"
#include "src/render/job/loaded_scene.h"
#include "src/render/plan/plan_features.h"

namespace lanelight {

namespace {

// Without "error: strategy: " before it.
std::string Reason(const InputError& error) {
  const std::string text = error.what(), prefix = "strategy: ";
  const std::size_t at = text.find(prefix);
  return at == std::string::npos ? text : text.substr(at + prefix.size());
}

}  // namespace

void SceneRunner::CheckStrategies() {
  for (NamedStrategy& named :
       StudyStrategies(options_, job_.loaded->description.strategy)) {
    StrategyRuns runs;
    runs.named = std::move(named);
    plan_keys_.emplace_back();
    try {
      const Job job = WithStrategy(job_, runs.named.strategy);
      for (const std::string& note : job.plan.notes) {
        runs.message += (runs.message.empty() ? "" : "; ") + note;
      }
      FindTwin(runs, plan_keys_.back() = PlanKey(job.scene, job.plan));
    } catch (const InputError& error) {
      runs.status = RunStatus::kRefused;
      runs.message = Reason(error);
    }
    scene_.strategies.push_back(std::move(runs));
  }
}

// Renders of equal plans are equal, bit by bit: what would differ is their timing alone.
void SceneRunner::FindTwin(StrategyRuns& runs, const std::string& key) {
  const auto found = std::find(plan_keys_.begin(), plan_keys_.end() - 1, key);
  if (found == plan_keys_.end() - 1) return;
  runs.same_as = static_cast<std::size_t>(found - plan_keys_.begin());
  const NamedStrategy& twin = scene_.strategies[*runs.same_as].named;
  const bool equal = twin.strategy == runs.named.strategy;
  runs.status = RunStatus::kSame;
  runs.message = fmt::format("{} {}{}{}",
                             equal ? "is" : "does on this scene exactly what is done by",
                             twin.name, runs.message.empty() ? "" : ": ", runs.message);
}

}  // namespace lanelight
