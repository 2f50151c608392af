// decide=pilot: which change of roulette or guiding, if any, makes the render cheaper at
// equal error. All candidates learn what they need from a pilot of their own, shorter
// than that of a render; then the same pixels are rendered with each, with the points of
// the render: in four randomisations, whose scatter is the variance. Independent samples
// would show variance that the render does not have, and hide what a change does to the
// rest. The chosen one learns anew, as if it had been asked for.
//
// Shares of the planned samples: 1/100 for each candidate that learns (adjoint), 1/120
// for each that is compared: 3.5 percent, before the chosen one learns. Where few bright
// samples carry the error (veach-ajar) 10 000 samples see none of them, and even adjoint,
// whose gain these are, looks half as efficient as the default; 60 000 see it. So nothing
// is left out early, and short pilots stay with the default. What is decided depends on
// scene, settings and seed alone: costs are counted in rays.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "src/core/check.h"
#include "src/core/error.h"
#include "src/wavefront/decision_candidates.h"
#include "src/wavefront/path_records.h"
#include "src/wavefront/pilot_comparison.h"
#include "src/wavefront/plan_features.h"
#include "src/wavefront/plan_key.h"
#include "src/wavefront/run.h"
#include "src/wavefront/stop_watcher.h"
#include "src/wavefront/training.h"
#include "src/wavefront/training_pass.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kCompared = 120;  // of so many planned samples one is compared
constexpr std::uint64_t kLearned = 4;     // and candidates learn as if for a quarter
// Samples of a pixel: a render's randomisations are as long or longer.
constexpr std::uint32_t kSpp = 32;
constexpr std::uint64_t kLeastToCompare = 256;
// A change is made that is better by its margin and one standard error. What is made by
// mistake is mostly near its margin, and costs little; where the error is in rare bright
// samples the variances scatter so much that two would miss most of what gains there
// (veach-ajar: 1.6 times by 35 000 samples, 2.7 times in fact).
constexpr double kStandardErrors = 1;

struct Entry {
  std::string name, changes;  // as a candidate has it; in full
  double margin = 1;
  PlanOptions options;
  StrategyTables tables;
  PilotMeasure measure;
};

class Decider {
 public:
  explicit Decider(const TrainingContext& context)
      : scene_(context.scene),
        options_(context.plan.options),
        run_(context.run),
        training_(context.options),
        planned_(std::min(context.options.planned_samples, kMostDecidedBy)),
        tables_(context.tables),
        watcher_(context.options.stop) {}

  TrainingOutcome Run() {
    Add("", 1);
    for (const DecisionCandidate& c : kDecisionCandidates) Add(c.changes, c.margin);
    Entry* chosen = &entries_.front();
    if (entries_.size() == 1) {
      note_ = "no candidate does anything else here: the strategy is as given";
    } else if (planned_ / kCompared < kLeastToCompare) {
      note_ = "the image has too few samples to compare: the strategy is as given";
    } else {
      chosen = Compare();
    }
    if (!Stopped()) TrainFor(*chosen);
    return outcome_;
  }

 private:
  bool Stopped() const { return training_.stop != nullptr && *training_.stop; }

  // Unless the scene refuses it, or another does the same there.
  void Add(const std::string& changes, double margin) {
    Entry entry;
    entry.name = changes;
    entry.changes = changes.empty() ? "decide=none" : changes + ",decide=none";
    entry.margin = margin;
    entry.options = options_;
    entry.options.changes = entry.changes;
    try {
      const std::string key = PlanKey(scene_, MakePlan(scene_, entry.options));
      if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) return;
      keys_.push_back(key);
    } catch (const InputError&) {
      if (entries_.empty()) throw;
      return;
    }
    entry.tables = MakeStrategyTables(scene_);
    entries_.push_back(std::move(entry));
  }

  // What the strategy of an entry learns beforehand, for so many planned samples.
  TrainingOutcome Learn(const Entry& entry, std::uint64_t planned,
                        StrategyTables& tables) {
    const Plan plan = MakePlan(scene_, entry.options);
    if (!NeedsTraining(plan)) return {};
    RunParameters run = run_;
    run.features = plan.features;
    run.tables = &tables;
    TrainingOptions options = training_;
    options.planned_samples = planned;
    options.keep_roulette |= !entry.name.empty();
    const TrainingOutcome out = Train({scene_, plan, run, options, tables});
    outcome_.samples += out.samples;
    outcome_.rays += out.rays;
    return out;
  }

  TrainingSamples Render(const Entry& entry) {
    PlanOptions options = entry.options;
    options.aov = false;
    options.training = FeatureSet{};
    options.own_points = true;
    RunParameters run = run_;
    run.tables = &entry.tables;
    TrainingSamples samples = RunTrainingPass(scene_, options, run, work_, &watcher_);
    outcome_.samples += samples.colors.size();
    outcome_.rays += samples.rays_closest + samples.rays_shadow;
    return samples;
  }

  void MakeWork() {
    work_ = MakeTrainingWork(scene_, planned_ / kCompared, kSpp);
    work_.spp -= work_.spp % kReplicates;
  }

  // Of efficiency; 1 where there is no error.
  static double Gain(const PilotMeasure& usual, const PilotMeasure& other) {
    const double score = other.Score();
    return score > 0 ? usual.Score() / score : 1;
  }

  Entry* Compare() {
    Entry* const usual = &entries_.front();
    MakeWork();
    for (Entry& entry : entries_) {
      const TrainingOutcome out = Learn(entry, planned_ / kLearned, entry.tables);
      // It may have found that it had better be something else.
      entry.options.Change(out.changes);
      const TrainingSamples samples = Stopped() ? TrainingSamples() : Render(entry);
      if (Stopped()) return usual;
      // Weights are those of the image that the strategy as given shows.
      if (!image_) image_.emplace(run_.width, run_.height, work_.pixels, samples.colors);
      entry.measure = {samples.Cost(), RelativeVariances(samples, work_, *image_)};
    }
    return Choose();
  }

  Entry* Choose() {
    const PilotMeasure& usual = entries_.front().measure;
    Entry* chosen = &entries_.front();
    for (Entry& entry : entries_) {
      if (entry.name.empty() ||
          !IsClearlyBetter(entry.measure, usual, entry.margin, kStandardErrors)) {
        continue;
      }
      if (entry.measure.Score() < chosen->measure.Score()) chosen = &entry;
    }
    Explain(*chosen);
    return chosen;
  }

  void Explain(const Entry& chosen) {
    const PilotMeasure& usual = entries_.front().measure;
    std::string others;
    for (const Entry& entry : entries_) {
      if (entry.name.empty()) continue;
      others += fmt::format("{}{} {:.2f}", others.empty() ? "" : ", ", entry.name,
                            Gain(usual, entry.measure));
    }
    const std::string what = chosen.name.empty()
                                 ? "nothing is clearly better than the strategy as given"
                                 : "rendered with " + chosen.name;
    note_ = fmt::format(
        "{}; efficiency relative to the strategy as given, by {} samples "
        "of a few pixels: {}",
        what, work_.samples(), others);
  }

  void TrainFor(Entry& chosen) {
    chosen.options.changes = chosen.changes;
    const TrainingOutcome out = Learn(chosen, training_.planned_samples, tables_);
    outcome_.changes = chosen.changes;
    if (!out.changes.empty()) outcome_.changes += "," + out.changes;
    outcome_.note = note_ + (out.note.empty() ? "" : "; " + out.note);
  }

  const CompiledScene& scene_;
  const PlanOptions& options_;
  const RunParameters& run_;
  const TrainingOptions& training_;
  const std::uint64_t planned_;
  StrategyTables& tables_;
  const StopWatcher watcher_;
  std::vector<Entry> entries_;  // the first: the strategy as given
  std::vector<std::string> keys_;
  TrainingWork work_;
  std::optional<ImageGuess> image_;
  std::string note_;
  TrainingOutcome outcome_;
};

}  // namespace

std::uint64_t DecidedBy(std::uint64_t pixels) {
  return std::clamp(pixels * kPilotSpp, kLeastDecidedBy, kMostDecidedBy);
}

TrainingOutcome TrainDecision(const TrainingContext& context) {
  return Decider(context).Run();
}

}  // namespace lanelight
