// The renders of a study on one scene.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "src/base/core/error.h"
#include "src/base/core/file_lock.h"
#include "src/base/core/stopwatch.h"
#include "src/measure/study/runs.h"

namespace lanelight {

/// The directory holds the study of something else: nothing of it may be mixed up.
class OtherStudy : public InputError {
  using InputError::InputError;
};

/// Time left of a study, from what its work so far took. Work is counted in samples;
/// scenes that have not started are taken to be like those that have.
class StudyClock {
 public:
  explicit StudyClock(std::size_t scenes) : scenes_left_(scenes) {}

  void StartScene(double work);
  void Worked(double work) { done_ += work; }
  void FinishScene();
  double Seconds() const { return watch_.Seconds(); }
  /// Of the whole study, in [0, 1].
  double Fraction() const;
  double SecondsLeft() const;

 private:
  double Total() const;

  Stopwatch watch_;
  std::size_t scenes_left_, scenes_started_ = 0;
  double planned_ = 0, done_ = 0;
  bool started_ = false;
};

class SceneRunner {
 public:
  SceneRunner(const StudyOptions& options, const StudyHooks& hooks, StudyClock& clock,
              SceneRuns& scene);
  /// Throws InputError if the scene cannot be rendered at all.
  void Run();

 private:
  void Prepare();
  void CheckStrategies();
  void FindTwin(StrategyRuns& runs, const std::string& key);
  void Settle();
  void CheckState();
  void SaveState();
  void FindCounts();
  void FindReference();
  void LoadReference();
  std::string ReferencePath() const;
  std::uint64_t ReferenceSamples() const;
  void PlanWork();
  void RunCells();
  void RunDiffuseModels();
  bool RunRepetition(StrategyRuns& runs, std::uint64_t spp, int repetition);
  void WaitForOthers();
  bool FillCell(StrategyRuns& runs, std::uint64_t spp, int repetition);
  bool RenderRepetition(StrategyRuns& runs, std::uint64_t spp, int repetition,
                        Cells& cells);
  Measurement Render(const StrategyRuns& runs, std::uint64_t spp, int repetition,
                     Cells& cells);
  /// Largest sample count of any strategy.
  std::uint64_t MostSamples() const;
  std::uint64_t Seed(int repetition) const;
  bool Stopped() const;
  /// Waits for the claim of this name; empty if the study is stopped before.
  std::optional<HeldLock> WaitForClaim(const std::string& name) const;
  void Report(const std::string& what);
  double Work(std::uint64_t spp) const;  // of one render, in samples

  const StudyOptions& options_;
  const StudyHooks& hooks_;
  StudyClock& clock_;
  SceneRuns& scene_;
  Job job_;
  std::unique_ptr<CellStore> store_;
  std::unique_ptr<LockFile> claims_;    // of its cells: a strategy at a sample count
  std::vector<std::string> plan_keys_;  // of the strategies; empty: refused
  std::set<std::pair<StrategyRuns*, std::uint64_t>> elsewhere_;  // others had them
  nlohmann::json state_;                                         // scene.json
};

}  // namespace lanelight
