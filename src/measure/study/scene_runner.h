// Renders a study's cells of one scene.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "src/base/core/error.h"
#include "src/base/core/file_lock.h"
#include "src/base/core/stopwatch.h"
#include "src/measure/study/runs.h"

namespace lanelight {

/// Thrown if the directory has a study with other settings.
class OtherStudy : public InputError {
  using InputError::InputError;
};

/// Estimates the remaining time of a study. Work is counted in samples; scenes that have
/// not started count like the average of the others.
class StudyClock {
 public:
  explicit StudyClock(std::size_t scenes) : scenes_left_(scenes) {}

  void StartScene(double work);
  void AddDoneWork(double work) { done_ += work; }
  void FinishScene();
  double Seconds() const { return watch_.Seconds(); }
  /// Returns the finished fraction of the study.
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
  void FindEquivalent(StrategyRuns& runs, const std::string& key);
  void ChooseCountsAndReference();
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
  /// Returns the largest sample count of any strategy.
  std::uint64_t MaxSamples() const;
  std::uint64_t Seed(int repetition) const;
  bool IsStopped() const;
  /// Waits for a claim; empty if the study is stopped before.
  std::optional<ScopedLock> WaitForClaim(const std::string& name) const;
  void Report(const std::string& what);
  double Work(std::uint64_t spp) const;  // work of one render, in samples

  const StudyOptions& options_;
  const StudyHooks& hooks_;
  StudyClock& clock_;
  SceneRuns& scene_;
  Job job_;
  std::unique_ptr<CellStore> store_;
  std::unique_ptr<LockFile> claims_;    // for cells: a strategy at a sample count
  std::vector<std::string> plan_keys_;  // of strategies; empty if refused
  std::set<std::pair<StrategyRuns*, std::uint64_t>>
      elsewhere_;         // claimed by other processes
  nlohmann::json state_;  // scene.json
};

/// Speed of a strategy by timed renders.
struct Calibration {
  double samples = 1;  // per pixel in the budget, at least 1
  /// Standard error of log(samples), by the scatter of timed renders.
  double deviation = 0;
  /// Samples per pixel for a relative error of kSmallError, by estimates of the timed
  /// renders; infinite without estimates.
  double for_small_error = std::numeric_limits<double>::infinity();
};

struct TimedRender {
  double samples = 0, seconds = 0;
};

/// Returns the samples for a budget by the line through two timed renders, since training
/// and set-up take the same time for any size. The slope is limited to 0.25 to 1 times
/// the mean time per sample of the longer render, because of noise.
double SamplesOfBudget(double budget, const TimedRender& timed, const TimedRender& few);

/// Calibrates strategies to `seconds` of wall clock each. Warm-up renders fill caches and
/// find a size. Then renders of about half the budget (kMinTimedSeconds to
/// kMaxTimedSeconds) and of a quarter of their samples are timed kTimedRounds times. They
/// run in turns (A B C A B C ...), so that changes of the machine's speed affect all.
/// Uses medians of processor time, which excludes other programs, and one ratio of wall
/// clock to processor time for all. Empty if `stop` was set.
std::vector<Calibration> Calibrate(const Job& job,
                                   const std::vector<Strategy>& strategies,
                                   double seconds, const std::atomic<bool>* stop);
inline constexpr int kTimedRounds = 5;
inline constexpr double kMinTimedSeconds = 0.02, kMaxTimedSeconds = 1;

/// Returns the largest sample count of a study without given counts or budget: a power of
/// two for kDefaultStudySeconds, but at least kMinLargest or enough for an error of
/// kSmallError, since few samples may rank differently.
std::uint64_t DefaultLargest(const Calibration& baseline);

/// Returns powers of two below `largest`, and `largest` rounded down to seven binary
/// digits.
std::vector<std::uint64_t> CountsUpTo(std::uint64_t largest);

/// Sets ascending sample counts, and their spread, of strategies with status kOk: the
/// given counts, or up to those of the budget for each strategy, or powers of two up to
/// DefaultLargest() of the first strategy. None if `stop` was set.
void ChooseCounts(const StudyOptions& options, const Job& job,
                  std::vector<StrategyRuns>& strategies, const std::atomic<bool>* stop);

}  // namespace lanelight
