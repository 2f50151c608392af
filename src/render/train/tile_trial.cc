// Decides whether path reuse (reuse=block) or light subpaths (light-paths=splats) are
// more efficient, from a few samples of whole tiles with and without them, with the same
// random numbers. With path reuse paths are the same up to their second vertices, so a
// rare bright one is in both.
//
// A subpath brings light to pixels anywhere. Its variance is the sum of the squares of
// what the subpaths of some pixels bring to all of the image, scaled to all pixels. Light
// that camera paths find rarely, such as a caustic, is missing in a short pass without
// subpaths. Subpaths find it: a contribution c whose MIS weight is w adds c^2 to the
// second moment with subpaths, and c^2 / (1 - w) to that of camera paths alone. The mean
// of this estimate and that of the pass without subpaths counts: the former leaves out
// what subpaths take off camera paths' own contributions, the latter varies from seed to
// seed. The worst tiles are omitted: bright camera paths that subpaths cannot find (a
// caustic in a mirror) are in both passes, and no brighter with subpaths.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/strategy_trial.h"
#include "src/render/wave/task_runner.h"
#include "src/scene/compiled/view.h"
#include "src/scene/description/film.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kTileSpp = 8;
constexpr int kSquare = SubpathVariance::kSide;  // pixels
constexpr std::size_t kOmittedTiles = 8;         // of so many one, with light subpaths
constexpr double kGainStandardErrors = 1;        // standard errors
// Least gain after a filter, if there is one by pixels; a gain that is less by chance
// does no harm. In cornell-box reuse=block:32 gains 4.7x by pixels and 0.92x to 1.26x
// after a filter, by four seeds.
constexpr double kMinFilteredGain = 0.95;
// A later candidate replaces an earlier one if its joint gain is this much larger.
constexpr double kClearlyBetter = 1.5;
constexpr double kMaxGainOfFewSubpaths = 4;  // with which more of them are tried
constexpr double kSlightlyBetter = 1.1;      // of candidates of one kind

// Places of pixels in the work, by the square of the image that they are in.
using Squares = std::vector<std::vector<std::size_t>>;

// Places of pixels in the work that count: light that the camera sees at the edge of a
// lamp is integrated apart in the image, but not in a trial.
std::vector<bool> PixelsWithoutLightEdges(const PreparedScene& scene,
                                          const TriedStrategy& baseline,
                                          const TrainingWork& work) {
  std::vector<bool> counted(work.pixels.size(), true);
  const Plan plan = MakePlan(scene, baseline.options);
  RunParameters run = MakeRunParameters(scene, plan);
  run.tables = &baseline.tables;
  const RunOptions once;
  TaskRunner runner(scene, plan, run, once, {});
  runner.Begin(work.tiles.size());
  if (runner.visible_lights() == nullptr) return counted;
  ParallelFor(work.tiles.size(), [&](std::size_t tile) {
    runner.FindVisibleLights(tile, work.tiles[tile]);
  });
  std::size_t first = 0;
  for (std::size_t tile = 0; tile < work.tiles.size(); ++tile) {
    for (const std::uint32_t place : runner.visible_lights()->Of(tile)) {
      counted[first + place] = false;
    }
    first += work.tiles[tile].pixels();
  }
  return counted;
}

// Returns the pixels that count, by squares of this side.
Squares SquaresOf(const PreparedScene& scene, const TrainingWork& work,
                  const std::vector<bool>& counted, int side) {
  const auto width = std::uint32_t(scene.view->film.width);
  const auto each = std::uint32_t(side);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> squares;
  for (std::size_t i = 0; i < work.pixels.size(); ++i) {
    if (!counted[i]) continue;
    const std::uint32_t x = work.pixels[i] % width, y = work.pixels[i] / width;
    squares[{y / each, x / each}].push_back(i);
  }
  Squares out;
  for (auto& [at, places] : squares) out.push_back(std::move(places));
  return out;
}

// Sums of the pixels' variances.
std::vector<double> Summed(const std::vector<double>& variances, const Squares& squares) {
  std::vector<double> out;
  for (const std::vector<std::size_t>& square : squares) {
    double& sum = out.emplace_back();
    for (const std::size_t i : square) sum += variances[i];
  }
  return out;
}

bool IsPlanned(const PreparedScene& scene, const PlanOptions& options, Feature feature) {
  try {
    return MakePlan(scene, options).features.Has(feature);
  } catch (const InputError&) {
    return false;  // it does not go together with all else
  }
}

SubpathVariance VarianceOfSubpaths(const TrainingSamples& samples, std::uint32_t spp,
                                   std::size_t pixel) {
  SubpathVariance variance;
  std::memcpy(&variance, &samples.recorded[pixel * spp * kSubpathPlanes],
              sizeof(variance));
  return variance;
}

// Averages two estimates of the same, of which the second may end earlier.
void Average(const TrialMeasure& other, TrialMeasure& measure) {
  measure.variances.resize(other.variances.size());
  for (std::size_t i = 0; i < other.variances.size(); ++i) {
    measure.variances[i] = (measure.variances[i] + other.variances[i]) / 2;
  }
}

bool IsOfLightPaths(const DecisionCandidate& candidate) {
  return std::strncmp(candidate.changes, "light-paths", 11) == 0;
}

// Returns the gain of one change after another.
TrialGain JoinedGain(const TrialGain& first, const TrialGain& second) {
  return {first.log + second.log, std::hypot(first.standard_error, second.standard_error),
          first.minimum + second.minimum};
}

// Compares strategies with a plain one on the same tiles.
class TileTrial {
 public:
  TileTrial(const PreparedScene& scene, const TriedStrategy& baseline, TrainingWork work,
            TrainingSamples plain)
      : scene_(scene),
        work_(std::move(work)),
        plain_(std::move(plain)),
        image_(EstimatePilotImage(scene_, plain_, work_)) {
    const std::vector<bool> counted = PixelsWithoutLightEdges(scene_, baseline, work_);
    tiles_ = SquaresOf(scene_, work_, counted, kReuseTile);
    squares_ = SquaresOf(scene_, work_, counted, kSquare);
    // All pixels: what their subpaths bring falls on others.
    const std::vector<bool> all(counted.size(), true);
    all_tiles_ = SquaresOf(scene_, work_, all, kReuseTile);
  }

  const TrainingWork& work() const { return work_; }
  const PilotImage& image() const { return image_; }

  // Sets the gains of the strategy that has rendered these samples. `fewer`: the one
  // before, with fewer light subpaths. How much light camera paths alone would scatter
  // depends on the number of subpaths, so more of them are compared with fewer.
  void Compare(const TrainingSamples& samples, const TriedOnTiles* fewer,
               TriedOnTiles& out) {
    const double cost = out.candidate.price * samples.Cost();
    Measures with = {{cost, ByTiles(samples)}, {cost, BySquares(samples)}};
    Measures plain = {{plain_.Cost(), ByTiles(plain_)},
                      {plain_.Cost(), BySquares(plain_)}};
    const bool subpaths = samples.planes == kSubpathPlanes;
    if (subpaths) CountSubpaths(samples, with, plain);
    if (fewer != nullptr) plain = before_;
    const auto gain_of = [&](const TrialMeasure& other, const TrialMeasure& baseline) {
      // Bright paths that no subpath finds limit what more subpaths gain.
      if (!subpaths || fewer != nullptr) return GainOf(other, baseline);
      return GainWithoutWorst(other, baseline,
                              std::max<std::size_t>(1, tiles_.size() / kOmittedTiles));
    };
    out.per_pixel = gain_of(with.by_tiles, plain.by_tiles);
    out.filtered = gain_of(with.by_squares, plain.by_squares);
    before_ = std::move(with);
    if (fewer == nullptr) return;
    out.per_pixel = JoinedGain(fewer->per_pixel, out.per_pixel);
    out.filtered = JoinedGain(fewer->filtered, out.filtered);
  }

 private:
  struct Measures {
    TrialMeasure by_tiles, by_squares;
  };

  // Adds what subpaths cause, and averages the measures without them with those by the
  // same samples.
  void CountSubpaths(const TrainingSamples& samples, Measures& with,
                     Measures& plain) const {
    Measures without = with;
    AddSubpaths(samples, with, without);
    Average(without.by_tiles, plain.by_tiles);
    Average(without.by_squares, plain.by_squares);
  }

  std::vector<double> ByTiles(const TrainingSamples& samples) const {
    return Summed(RelativeVariances(samples, work_, image_), tiles_);
  }
  std::vector<double> BySquares(const TrainingSamples& samples) const {
    std::vector<double> variances;
    for (const std::vector<std::size_t>& square : squares_) {
      variances.push_back(double(square.size()) *
                          VarianceOfMean(samples, work_, image_, square));
    }
    return variances;
  }

  // Adds what the subpaths cause, by the tiles in which they started.
  void AddSubpaths(const TrainingSamples& samples, Measures& with,
                   Measures& without) const {
    const auto add = [&](float SubpathVariance::* member, TrialMeasure& measure) {
      std::vector<double> variances;
      for (std::size_t i = 0; i < work_.pixels.size(); ++i) {
        variances.push_back(double(VarianceOfSubpaths(samples, work_.spp, i).*member));
      }
      for (const double v : Summed(variances, all_tiles_)) measure.variances.push_back(v);
    };
    add(&SubpathVariance::by_pixels, with.by_tiles);
    add(&SubpathVariance::by_squares, with.by_squares);
    add(&SubpathVariance::camera_by_pixels, without.by_tiles);
    add(&SubpathVariance::camera_by_squares, without.by_squares);
  }

  const PreparedScene& scene_;
  const TrainingWork work_;
  const TrainingSamples plain_;
  Measures before_;  // of the last strategy
  const PilotImage image_;
  Squares tiles_, squares_, all_tiles_;
};

// Returns whether a variant of what has just been tried is worth a try.
bool IsWorthTrying(const DecisionCandidate& candidate, const TriedOnTiles& before) {
  // Smaller blocks gain less by pixels and more after a filter.
  if (std::strcmp(candidate.changes, "reuse=block:32") == 0) {
    return before.has_gain_per_pixel && before.filtered.log < std::log(kMinFilteredGain);
  }
  // More subpaths gain where camera paths are expensive. Where subpaths gain much, the
  // rest is light that they do not find, in samples too rare for a trial: with four times
  // as many, caustic and veach-bidir have 0.6x the efficiency (trials say 1.8x).
  if (std::strcmp(candidate.changes, "light-paths=splats:1") == 0) {
    return before.has_gain_per_pixel &&
           before.LogJointGain() < std::log(kMaxGainOfFewSubpaths);
  }
  return true;
}

}  // namespace

double TriedOnTiles::LogJointGain() const {
  return (per_pixel.minimum + filtered.minimum) / 2;
}

void TriedOnTiles::Judge(double must_gain) {
  const double clear = per_pixel.minimum - kGainStandardErrors * per_pixel.standard_error;
  has_gain_per_pixel =
      clear > std::log(kMinChangeGain) && per_pixel.log > std::log(must_gain);
  is_efficient =
      has_gain_per_pixel && filtered.log + kGainStandardErrors * filtered.standard_error >
                                std::log(kMinFilteredGain);
}

const TriedOnTiles* BestOf(const std::vector<TriedOnTiles>& tried) {
  // Path reuse gains more per pixel, light subpaths more after a filter. Errors of larger
  // and smaller blocks, and of more and fewer subpaths, have much in common.
  const TriedOnTiles* best = nullptr;
  for (const TriedOnTiles& t : tried) {
    if (!t.is_efficient) continue;
    const bool alike =
        best != nullptr && IsOfLightPaths(best->candidate) == IsOfLightPaths(t.candidate);
    const double clear = std::log(alike ? kSlightlyBetter : kClearlyBetter);
    if (best == nullptr || t.LogJointGain() > best->LogJointGain() + clear) best = &t;
  }
  return best;
}

bool StrategyTrial::MayUse(const TriedStrategy& beside, const char* changes) const {
  const PlanOptions options = WithChanges(scene_, beside.options, changes);
  if (IsPlanned(scene_, options, Feature::kReuse)) return true;
  return training_.whole_image && options.max_depth > 1 &&
         RenderedPixels(scene_.view->film).pixels() <= kMaxTrialSplatPixels &&
         IsPlanned(scene_, options, Feature::kLightPaths);
}

void StrategyTrial::LearnEmission(const PlanOptions& options, TriedStrategy& tried) {
  const Plan plan = MakePlan(scene_, options);
  if (!plan.features.Has(Feature::kGuidedEmission) ||
      tried.tables.emission.has_learned()) {
    return;
  }
  const TrainingOutcome outcome =
      TrainEmission({scene_, plan, seed_, training_, tried.tables});
  spent_.samples += outcome.samples;
  spent_.rays += outcome.rays;
}

std::vector<TriedOnTiles> StrategyTrial::TryOnTiles(const TriedStrategy& baseline,
                                                    const TriedStrategy& chosen,
                                                    double gain, std::uint64_t samples) {
  std::vector<TriedOnTiles> tried;
  const bool splits = chosen.strategy.Splits();
  const TriedStrategy& beside = splits ? baseline : chosen;
  if (beside.strategy.Splits()) return tried;
  const double must_gain = splits ? gain : kMinChangeGain;
  std::optional<TileTrial> trial;
  TriedStrategy learned = beside;
  for (const DecisionCandidate& candidate : kTileCandidates) {
    if (!MayUse(beside, candidate.changes)) continue;
    if (!tried.empty() && !IsWorthTrying(candidate, tried.back())) continue;
    if (!trial) {
      const TrainingWork work = MakeTileWork(scene_, samples, kTileSpp);
      trial.emplace(scene_, beside, work, Render(beside, beside.options, work));
    }
    const PlanOptions options = WithChanges(scene_, beside.options, candidate.changes);
    LearnEmission(options, learned);
    const TrainingSamples found =
        Render(learned, options, trial->work(), &trial->image());
    if (watcher_.IsStopped()) break;
    tried.emplace_back().candidate = candidate;
    const bool more = tried.size() > 1 && IsOfLightPaths(candidate) &&
                      IsOfLightPaths(tried[tried.size() - 2].candidate);
    trial->Compare(found, more ? &tried[tried.size() - 2] : nullptr, tried.back());
    tried.back().Judge(must_gain);
  }
  return tried;
}

}  // namespace lanelight
