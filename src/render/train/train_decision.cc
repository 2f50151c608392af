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
// light-selection=learned comes first: all others are tried beside what has been chosen.
// Path reuse and light subpaths are tried last, on whole tiles.
//
// Shares of the planned samples: 1/100 for each candidate that learns, 1/120
// for each that is compared, up to five times 1/200 on tiles, 1/100 for subpaths from
// infinity: 9 percent, before the chosen one learns. What is decided depends on scene,
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
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"

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

// Samples of a tile lie at the same places in their pixels, so what few of them miss of a
// gradient is an error of all pixels. With 32 samples per pixel that is 1 to 14 percent
// of the error after a filter of 8 x 8 pixels (cornell-box, blinds, coffee), with 128 at
// most 3.
// Planned samples count (DecidedBy), so that a render may go on.
constexpr std::uint64_t kMinSharedSpp = 16;

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
    entries_.reserve(2 + std::size(kRouletteCandidates));
    Add("", 1);
    TriedStrategy* chosen = &entries_.front();
    const TriedStrategy* base = chosen;
    if (planned_ / kCompared < kMinComparedSamples) {
      note_ = "the image has too few samples to compare";
    } else {
      trial_.Begin(planned_ / kCompared);
      base = chosen = Improve(*chosen, std::span(&kLearnedSelection, 1));
      tables_.lights = chosen->tables.lights;
      chosen = Improve(*chosen, kRouletteCandidates);
      if (note_.empty()) note_ = "no candidate changes this render";
      if (!trial_.IsStopped()) TryOnTilesBeside(*base, *chosen);
    }
    if (!trial_.IsStopped()) TrainFor(*chosen);
    outcome_.samples = trial_.spent().samples;
    outcome_.rays = trial_.spent().rays;
    return outcome_;
  }

 private:
  // Returns the change that shares samples, or nothing where it cannot be used. It needs
  // no trial: what it gains follows from the filter, beside any strategy.
  std::string SharingOf() const {
    const std::uint64_t pixels = RenderedPixels(scene_.view->film).pixels();
    if (training_.planned_samples / pixels < kMinSharedSpp) return "";
    const std::string change = "pixel-samples=shared";
    try {
      const Plan plan = MakePlan(scene_, WithChanges(scene_, options_, change));
      return plan.features.Has(Feature::kSharedPixelSamples) ? change : "";
    } catch (const InputError&) {
      return "";
    }
  }

  // Adds an entry, unless the scene refuses it, or another does the same there.
  TriedStrategy* Add(const std::string& changes, double price) {
    TriedStrategy entry = PrepareTrial(scene_, options_, changes, price);
    try {
      const std::string key = PlanKey(scene_, MakePlan(scene_, entry.options));
      if (std::ranges::find(keys_, key) != keys_.end()) return nullptr;
      keys_.push_back(key);
    } catch (const InputError&) {
      if (entries_.empty()) throw;
      return nullptr;
    }
    return &entries_.emplace_back(std::move(entry));
  }

  // Compares changes beside a strategy. Returns the best, which may be the strategy
  // itself.
  TriedStrategy* Improve(TriedStrategy& base,
                         std::span<const DecisionCandidate> candidates) {
    TriedStrategy* best = &base;
    double maximum = 0;
    std::string gains;
    for (const DecisionCandidate& c : candidates) {
      TriedStrategy* const entry =
          Add(JoinedChanges(base.changes, c.changes), base.price * c.price);
      if (entry == nullptr) continue;
      if (!base.has_learned && !trial_.Try(base, base)) return &base;
      entry->tables.lights = base.tables.lights;
      if (&c == &kLearnedSelection) {
        // The render uses the same table.
        trial_.TrainStrategy(*entry, training_.planned_samples, entry->tables);
        entry->has_learned = true;
      }
      if (!trial_.Try(*entry, base)) return &base;
      gains += fmt::format("{}{} {:.2f}", gains.empty() ? "" : ", ", c.changes,
                           std::exp(entry->EfficiencyGain().log));
      const double beyond = entry->SignificantLogGain(kMinChangeGain, kStandardErrors);
      if (beyond <= maximum) continue;
      maximum = beyond;
      best = entry;
    }
    if (gains.empty()) return best;
    note_ += note_.empty()
                 ? fmt::format("efficiency over the given strategy ({} samples)",
                               trial_.samples())
                 : "; beside what has been chosen";
    note_ += ": " + gains;
    return best;
  }

  // Tries path reuse and light subpaths beside what has been chosen, or in its place
  // where that splits paths.
  void TryOnTilesBeside(const TriedStrategy& base, TriedStrategy& chosen) {
    const double gain = &base == &chosen ? 1 : std::exp(chosen.Gain().log);
    const std::vector<TriedOnTiles> tried =
        trial_.TryOnTiles(base, chosen, gain, planned_ / kTiled);
    for (const TriedOnTiles& t : tried) {
      note_ +=
          fmt::format("; {} gains {:.2f}x, {:.2f}x after a filter", t.candidate.changes,
                      std::exp(t.per_pixel.log), std::exp(t.filtered.log));
    }
    // Over the strategy as given.
    const double of_base = base.changes.empty() ? 0 : base.EfficiencyGain().log;
    const double own = &base == &chosen ? 0 : chosen.EfficiencyGain().log;
    if (!chosen.changes.empty()) {
      outcome_.gain = outcome_.filtered_gain = LimitedGain(of_base + own);
    }
    const TriedOnTiles* const best = BestOf(tried);
    if (best == nullptr) return;
    const double before = of_base + (chosen.strategy.Splits() ? 0 : own);
    outcome_.gain = LimitedGain(before + best->per_pixel.log);
    outcome_.filtered_gain = LimitedGain(before + best->filtered.log);
    TriedStrategy beside = chosen.strategy.Splits() ? base : chosen;
    beside.changes = JoinedChanges(beside.changes, best->candidate.changes);
    chosen = std::move(beside);
  }

  void TrainFor(TriedStrategy& chosen) {
    const std::string rendered = JoinedChanges(SharingOf(), chosen.changes);
    const std::string changes = JoinedChanges(rendered, "decide=none");
    chosen.options = WithChanges(scene_, options_, changes);
    const TrainingOutcome out =
        trial_.TrainStrategy(chosen, training_.planned_samples, tables_);
    outcome_.changes = changes;
    outcome_.note = fmt::format("rendered with {}; {}{}{}",
                                rendered.empty() ? "the strategy as given" : rendered,
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
