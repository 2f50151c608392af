// decide=pilot: which change of roulette, reuse or light subpaths, if any, makes the
// render cheaper at equal error. All candidates learn what they need from a pilot of
// their own, shorter than that of a render; then the same pixels are rendered with each,
// with the points of the render: in four randomisations, whose scatter is the variance.
// Independent samples would show variance that the render does not have, and hide what a
// change does to the rest. The chosen one learns anew, as if it had been asked for.
//
// Where few bright samples carry the error, all pixels have to count, the worst most of
// all: they are what roulette=adjoint is for. One pilot sees few of them or none. So the
// variance of the strategy as given is estimated twice: from its own pass, and from the
// copies of paths in the pass of adjoint, which has met other bright samples, and more of
// them (kernels/roulette/single_path_records.cc); the mean of both counts. A candidate
// without such a pair may owe its gain to a bright sample that only the other pass has
// met: it must be better without the worst thousandth of the pixels as well. If its paths
// live longer and that is all, no sample of it varies more; where few pixels carry the
// error all others decide.
//
// Path reuse and light subpaths are tried beside the chosen strategy, on whole tiles.
//
// Shares of the planned samples: 1/100 for each candidate that learns (adjoint), 1/120
// for each that is compared, up to five times 1/200 on tiles, 1/100 for subpaths from
// infinity: 7 percent, before the chosen one learns. What is decided depends on scene,
// settings and seed alone: costs are counted in rays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "src/base/core/error.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/strategy_trial.h"
#include "src/render/wave/run_options.h"

namespace lanelight {
namespace {

constexpr std::uint64_t kCompared = 120;  // of so many planned samples one is compared
constexpr std::uint64_t kTiled = 200;     // and so many on whole tiles
constexpr std::uint64_t kLearned = 4;     // and candidates learn as if for a quarter
constexpr std::uint64_t kMinComparedSamples = 256;
// A change must gain its least gain and half a standard error. A change made by mistake
// costs little; a missed one may cost a factor of three. On veach-ajar, trials of 4
// million planned samples find adjoint in 16 seeds of 16 with half a standard error, and
// in 12 with one. With one standard error of means without the worst thousandth of the
// pixels, they find it in none.
constexpr double kStandardErrors = 0.5;

// Logarithms of gains have no limit where a trial sees no noise.
double LimitedGain(double log) { return std::exp(std::clamp(log, -7.0, 7.0)); }

class Decider {
 public:
  explicit Decider(const TrainingContext& context)
      : scene_(context.scene),
        options_(context.plan.options),
        training_(context.options),
        planned_(std::min(context.options.planned_samples, kMaxTrialSamples)),
        tables_(context.tables),
        trial_(scene_, training_, context.seed, planned_ / kLearned) {}

  TrainingOutcome Run() {
    Add("", 1);
    for (const DecisionCandidate& c :
         std::span(kDecisionCandidates, kNumDefaultCandidates)) {
      Add(c.changes, c.price);
    }
    TriedStrategy* chosen = &entries_.front();
    if (entries_.size() == 1) {
      note_ = "no candidate changes this render";
    } else if (planned_ / kCompared < kMinComparedSamples) {
      note_ = "the image has too few samples to compare";
    } else {
      chosen = Compare();
    }
    if (!trial_.IsStopped() && planned_ / kCompared >= kMinComparedSamples)
      TryOnTilesBeside(*chosen);
    if (!trial_.IsStopped()) TrainFor(*chosen);
    outcome_.samples = trial_.spent().samples;
    outcome_.rays = trial_.spent().rays;
    return outcome_;
  }

 private:
  // Unless the scene refuses it, or another does the same there.
  void Add(const std::string& changes, double price) {
    TriedStrategy entry = PrepareTrial(scene_, options_, changes, price);
    try {
      const std::string key = PlanKey(scene_, MakePlan(scene_, entry.options));
      if (std::ranges::find(keys_, key) != keys_.end()) return;
      keys_.push_back(key);
    } catch (const InputError&) {
      if (entries_.empty()) throw;
      return;
    }
    entries_.push_back(std::move(entry));
  }

  TriedStrategy* Compare() {
    trial_.Begin(planned_ / kCompared);
    for (TriedStrategy& entry : entries_) {
      if (!trial_.Try(entry, entries_.front())) return &entries_.front();
    }
    return Choose();
  }

  // Tries path reuse and light subpaths beside what has been chosen, or in its place
  // where that splits paths.
  void TryOnTilesBeside(TriedStrategy& chosen) {
    const double gain = chosen.changes.empty() ? 1 : std::exp(chosen.Gain().log);
    const std::vector<TriedOnTiles> tried =
        trial_.TryOnTiles(entries_.front(), chosen, gain, planned_ / kTiled);
    for (const TriedOnTiles& t : tried) {
      note_ +=
          fmt::format("; {} gains {:.2f}x, {:.2f}x after a filter", t.candidate.changes,
                      std::exp(t.per_pixel.log), std::exp(t.filtered.log));
    }
    if (!chosen.changes.empty()) {
      outcome_.gain = outcome_.filtered_gain = LimitedGain(chosen.EfficiencyGain().log);
    }
    const TriedOnTiles* const best = BestOf(tried);
    if (best == nullptr) return;
    const bool replaces = chosen.splits || chosen.changes.empty();
    const double before = replaces ? 0 : chosen.EfficiencyGain().log;
    outcome_.gain = LimitedGain(before + best->per_pixel.log);
    outcome_.filtered_gain = LimitedGain(before + best->filtered.log);
    TriedStrategy beside = chosen.splits ? entries_.front() : chosen;
    beside.changes = JoinedChanges(beside.changes, best->candidate.changes);
    chosen = std::move(beside);
  }

  TriedStrategy* Choose() {
    TriedStrategy* chosen = &entries_.front();
    double maximum = 0;
    for (TriedStrategy& entry : entries_) {
      if (entry.changes.empty()) continue;
      const double beyond = entry.SignificantLogGain(kMinChangeGain, kStandardErrors);
      if (beyond <= maximum) continue;
      maximum = beyond;
      chosen = &entry;
    }
    Explain();
    return chosen;
  }

  void Explain() {
    std::string others;
    for (const TriedStrategy& entry : entries_) {
      if (entry.changes.empty()) continue;
      others += fmt::format("{}{} {:.2f}", others.empty() ? "" : ", ", entry.changes,
                            std::exp(entry.EfficiencyGain().log));
    }
    note_ = fmt::format("efficiency over the given strategy ({} samples): {}",
                        trial_.samples(), others);
  }

  void TrainFor(TriedStrategy& chosen) {
    const std::string changes = JoinedChanges(chosen.changes, "decide=none");
    chosen.options = WithChanges(scene_, options_, changes);
    const TrainingOutcome out =
        trial_.TrainStrategy(chosen, training_.planned_samples, tables_);
    outcome_.changes = JoinedChanges(changes, out.changes);
    outcome_.note =
        fmt::format("rendered with {}; {}{}{}",
                    chosen.changes.empty() ? "the strategy as given" : chosen.changes,
                    note_, out.note.empty() ? "" : "; ", out.note);
  }

  const PreparedScene& scene_;
  const PlanOptions& options_;
  const TrainingOptions& training_;
  const std::uint64_t planned_;
  StrategyTables& tables_;
  StrategyTrial trial_;
  std::vector<TriedStrategy> entries_;  // the first: the strategy as given
  std::vector<std::string> keys_;
  std::string note_;
  TrainingOutcome outcome_;
};

}  // namespace

std::uint64_t DecidedBy(std::uint64_t pixels) {
  return std::clamp(pixels * kTrainingSpp, kMinTrialSamples, kMaxTrialSamples);
}

TrainingOutcome TrainDecision(const TrainingContext& context) {
  return Decider(context).Run();
}

}  // namespace lanelight
