// Training of guiding=radiance: rounds, each of twice as many samples as the one before
// and guided by what was learned up to then; the first knows nothing. All rounds have
// independent samples, apart from the image's and from each other's, and none of them is
// in the image: dropped, they cost their share of the time (kShare) and nothing else.
// Every record is an estimate of the same radiance, whichever round it is from, so the
// guide learns from all of them, but for the oldest where there are too many; fractions
// come from the last round alone, which has not seen the guide that it judges.
#include "src/plan/plan_features.h"
#include "src/train/train_guide.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/core/stopwatch.h"
#include "src/prepare/guide_build.h"
#include "src/prepare/guide_cell.h"
#include "src/wave/stop_watcher.h"
#include "src/train/rank_passes.h"
#include "src/train/training.h"
#include "src/train/training_pass.h"

namespace lanelight {
namespace {

constexpr double kShare = 0.06;              // of the samples, or of the time
constexpr std::uint64_t kFirstRound = 4096;  // samples
constexpr std::uint64_t kMostSamples = 1u << 20;
constexpr std::uint64_t kPassSamples = 1u << 16;  // 144 bytes each
constexpr std::size_t kMostRecords = 2'000'000;   // 48 bytes each

class GuideTraining {
 public:
  explicit GuideTraining(const TrainingContext& context)
      : context_(context),
        guide_(context.tables.guide),
        watcher_(context.options.stop),
        options_(context.plan.options) {
    options_.training = FeatureSet{Feature::kRecordsGuide};
    // A path that splits would be on record with its first copy only.
    if (context.plan.features.Has(Feature::kSplitting)) {
      options_ = WithChanges(context.scene, options_, "roulette=throughput");
    }
  }

  TrainingOutcome Run() {
    guide_ = UnknowingGuide();
    for (std::uint64_t samples = FirstRound(); samples > 0; samples = NextRound()) {
      Round(samples);
      if (watcher_.Stopped()) return outcome_;
      guide_ = BuildGuide(records_, {}, &summary_);
      ++rounds_;
    }
    outcome_.note = Note();
    return outcome_;
  }

 private:
  double Seconds() const { return kShare * context_.options.seconds; }
  bool Timed() const { return context_.options.seconds > 0; }

  // Samples of all rounds, where time does not decide.
  std::uint64_t Planned() const {
    return std::min(
        static_cast<std::uint64_t>(kShare * double(context_.options.planned_samples)),
        kMostSamples);
  }

  // Rounds of n, 2 n, 4 n ... make up what is planned.
  std::uint64_t FirstRound() const {
    if (Timed()) return kFirstRound;
    std::uint64_t rounds = 0;
    while (kFirstRound * ((std::uint64_t{2} << rounds) - 1) <= Planned()) ++rounds;
    return rounds > 0 ? Planned() / ((std::uint64_t{1} << rounds) - 1) : 0;
  }

  std::uint64_t NextRound() const {
    const std::uint64_t next = 2 * last_round_;
    if (!Timed()) return outcome_.samples + next <= Planned() ? next : 0;
    RankPasses* const ranks = context_.options.ranks;
    return ranks != nullptr ? ranks->LeadersOf(InTime(next)) : InTime(next);
  }

  // Samples of a round of so many for which there is time.
  std::uint64_t InTime(std::uint64_t next) const {
    // It will take twice as long; the last one takes what is left.
    const double left = Seconds() - watch_.Seconds();
    const double needs = 2 * (watch_.Seconds() - round_start_);
    if (outcome_.samples >= kMostSamples || left < 0.25 * needs) return 0;
    const double share = left < 1.5 * needs ? std::min(1.5, left / needs) : 1;
    return static_cast<std::uint64_t>(share * double(next));
  }

  void Round(std::uint64_t samples) {
    round_start_ = watch_.Seconds();
    last_round_ = samples;
    // What other guides have proposed says nothing of this one.
    for (GuideRecord& r : records_) r.guide = 0;
    for (std::uint64_t done = 0; done < samples && !watcher_.Stopped();) {
      done += Pass(std::min(samples - done, kPassSamples));
    }
    if (records_.size() > kMostRecords) {
      records_.erase(records_.begin(),
                     records_.end() - static_cast<std::ptrdiff_t>(kMostRecords));
    }
  }

  std::uint64_t Pass(std::uint64_t samples) {
    ++passes_;
    const TrainingWork work =
        MakeTrainingWork(context_.scene, samples, TrainingWork::kLeastSpp, passes_);
    const TrainingSamples found = RunTrainingPass(
        {context_.scene, options_, &context_.tables,
         GuidePassSeed(context_.seed, passes_), &watcher_, context_.options.ranks},
        work);
    outcome_.samples += found.colors.size();
    outcome_.rays += found.rays();
    if (!watcher_.Stopped()) ReadGuideRecords(found.recorded, guide_, records_);
    return found.colors.size();
  }

  std::string Note() const {
    if (rounds_ == 0) return "no guide: the image has too few samples";
    return fmt::format(
        "guide of {} cells from {} rays of {} samples, which proposes {:.0f} % of the "
        "directions; second moment {:.2f} of the material's alone",
        summary_.cells, summary_.records, outcome_.samples, 100 * summary_.fraction,
        summary_.gain);
  }

  const TrainingContext& context_;
  Guide& guide_;
  const StopWatcher watcher_;
  PlanOptions options_;
  const Stopwatch watch_;
  double round_start_ = 0;
  std::vector<GuideRecord> records_;
  std::uint64_t last_round_ = 0;
  std::uint32_t passes_ = 0;
  int rounds_ = 0;
  GuideSummary summary_;
  TrainingOutcome outcome_;
};

}  // namespace

TrainingOutcome TrainGuide(const TrainingContext& context) {
  return GuideTraining(context).Run();
}

}  // namespace lanelight
