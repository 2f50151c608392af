// Decides whether path reuse (reuse=block) is more efficient, from a few samples of whole
// tiles with and without it, with the same random numbers: paths are the same up to their
// second vertices, so a rare bright one is in both.
#include <cmath>
#include <map>
#include <utility>

#include "src/base/core/error.h"
#include "src/base/core/parallel.h"
#include "src/render/plan/plan_features.h"
#include "src/render/train/path_records.h"
#include "src/render/train/strategy_trial.h"
#include "src/render/wave/task_runner.h"
#include "src/scene/compiled/view.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kBlockSpp = 8;
constexpr int kSquare = 8;                 // pixels per side
constexpr double kGainStandardErrors = 1;  // standard errors
// Least gain after a filter, if reuse gains by pixels.
constexpr double kMinFilteredGain = 0.95;

// Places of pixels in the work, by the square of the image that they are in.
using Squares = std::vector<std::vector<std::size_t>>;

// Places of pixels in the work that count: light that the camera sees at the edge of a
// lamp is integrated apart in the image, but not in a trial.
std::vector<bool> PixelsWithoutLightEdges(const TriedStrategy& baseline,
                                          const TrainingWork& work) {
  std::vector<bool> counted(work.pixels.size(), true);
  const Plan plan = MakePlan(baseline.scene, baseline.options);
  RunParameters run = MakeRunParameters(baseline.scene, plan);
  run.tables = &baseline.tables;
  const RunOptions once;
  TaskRunner runner(baseline.scene, plan, run, once, {});
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

bool IsReusePlanned(const PreparedScene& scene, const PlanOptions& options) {
  try {
    return MakePlan(scene, options).features.Has(Feature::kReuse);
  } catch (const InputError&) {
    return false;  // it does not go together with all else
  }
}

}  // namespace

TriedBlocks StrategyTrial::CompareBlocks(const TriedStrategy& baseline,
                                         const PlanOptions& blocks,
                                         const TrainingWork& work, double must_gain) {
  const TrainingSamples plain = Render(baseline, baseline.options, work);
  const TrainingSamples shared = Render(baseline, blocks, work);
  const PilotImage image = EstimatePilotImage(scene_, plain, work);
  const std::vector<bool> counted = PixelsWithoutLightEdges(baseline, work);
  const Squares tiles = SquaresOf(scene_, work, counted, kReuseTile);
  const Squares squares = SquaresOf(scene_, work, counted, kSquare);
  const auto by_tiles = [&](const TrainingSamples& samples, double price) {
    return TrialMeasure{price * samples.Cost(),
                        Summed(RelativeVariances(samples, work, image), tiles)};
  };
  const auto by_squares = [&](const TrainingSamples& samples, double price) {
    TrialMeasure measure = {price * samples.Cost(), {}};
    for (const std::vector<std::size_t>& square : squares) {
      const double pixels = double(square.size());
      measure.variances.push_back(pixels * VarianceOfMean(samples, work, image, square));
    }
    return measure;
  };
  TriedBlocks out;
  out.gain = GainOf(by_tiles(shared, kReusePrice), by_tiles(plain, 1));
  out.per_pixel = std::exp(out.gain.log);
  out.filtered =
      std::exp(GainOf(by_squares(shared, kReusePrice), by_squares(plain, 1)).log);
  const double clear = out.gain.minimum - kGainStandardErrors * out.gain.standard_error;
  out.has_gain_per_pixel = clear > std::log(kMinChangeGain) && out.per_pixel > must_gain;
  out.is_efficient = out.has_gain_per_pixel && out.filtered > kMinFilteredGain;
  return out;
}

std::vector<TriedBlocks> StrategyTrial::TryBlocks(const TriedStrategy& baseline,
                                                  const TriedStrategy& chosen,
                                                  double gain, std::uint64_t samples) {
  std::vector<TriedBlocks> tried;
  const TriedStrategy& beside = chosen.splits ? baseline : chosen;
  if (beside.splits) return tried;
  const double must_gain = chosen.splits ? gain : kMinChangeGain;
  for (const char* const changes : {"reuse=block", "reuse=block:32"}) {
    const PlanOptions blocks = WithChanges(beside.scene, beside.options, changes);
    if (!IsReusePlanned(beside.scene, blocks)) break;
    const TrainingWork work = MakeTileWork(scene_, samples, kBlockSpp);
    const TriedBlocks found = CompareBlocks(beside, blocks, work, must_gain);
    if (watcher_.IsStopped()) break;
    tried.push_back(found);
    tried.back().changes = changes;
    if (found.is_efficient || !found.has_gain_per_pixel) break;
  }
  return tried;
}

}  // namespace lanelight
