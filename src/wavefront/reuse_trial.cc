#include "src/wavefront/reuse_trial.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "src/core/error.h"
#include "src/wavefront/path_records.h"
#include "src/wavefront/seen_lights.h"

namespace lanelight {
namespace {

constexpr std::uint32_t kSpp = 8;
constexpr int kSquare = 8;  // pixels per side
constexpr double kStandardErrors = 1;
// After a filter, where it has gained by pixels.
constexpr double kMayLose = 0.95;

// Places of pixels in the work that count: light that the camera sees at the edge of a
// lamp is integrated apart in the image, but not in a trial.
std::vector<bool> Counted(const CompiledScene& scene, const ReuseRival& usual,
                          const TrainingWork& work) {
  std::vector<bool> counted(work.pixels.size(), true);
  RunParameters run = MakeRunParameters(scene, MakePlan(scene, usual.options));
  run.tables = usual.tables;
  const auto edges = SeenLightEdges::Make(scene, usual.options, run);
  if (!edges) return counted;
  edges->Find(work.tiles);
  std::size_t first = 0;
  for (std::size_t tile = 0; tile < work.tiles.size(); ++tile) {
    for (const std::uint32_t place : edges->Of(tile)) counted[first + place] = false;
    first += work.tiles[tile].pixels();
  }
  return counted;
}

// Pixels that count, by the square of this side that they are in: their places in the
// work.
std::vector<std::vector<std::size_t>> Squares(const CompiledScene& scene,
                                              const TrainingWork& work,
                                              const std::vector<bool>& counted,
                                              int side) {
  const auto width = static_cast<std::uint32_t>(scene.film.width);
  const auto each = static_cast<std::uint32_t>(side);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> squares;
  for (std::size_t i = 0; i < work.pixels.size(); ++i) {
    if (!counted[i]) continue;
    const std::uint32_t x = work.pixels[i] % width, y = work.pixels[i] / width;
    squares[{y / each, x / each}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> out;
  for (auto& [at, places] : squares) out.push_back(std::move(places));
  return out;
}

// Variances of the mean of a square's pixels, per sample, each weighed by the pixels'
// relative errors.
std::vector<double> VariancesOfMeans(
    const TrainingSamples& samples, const TrainingWork& work, const ImageGuess& image,
    const std::vector<std::vector<std::size_t>>& squares) {
  const std::uint32_t n = samples.observations;
  std::vector<double> out;
  for (const std::vector<std::size_t>& square : squares) {
    const double pixels = double(square.size());
    double variance = 0;
    for (int c = 0; c < 3; ++c) {
      double sum = 0, squares_of = 0, weight = 0;
      for (std::uint32_t k = 0; k < n; ++k) {
        double of_one = 0;
        for (const std::size_t i : square) {
          for (std::uint32_t j = k; j < work.spp; j += n) {
            const Vec3f& color = samples.colors[i * work.spp + j];
            of_one += double(c == 0 ? color.x : c == 1 ? color.y : color.z) / pixels;
          }
        }
        sum += of_one, squares_of += of_one * of_one;
      }
      for (const std::size_t i : square) {
        weight += image.ErrorWeight(work.pixels[i], c) / pixels / 3;
      }
      const double scatter = std::max(0.0, squares_of - sum * sum / n) * n;
      variance += scatter / (n - 1) / work.spp * weight;
    }
    out.push_back(variance * pixels);
  }
  return out;
}

std::vector<double> Summed(const std::vector<double>& values,
                           const std::vector<std::vector<std::size_t>>& squares) {
  std::vector<double> out;
  for (const std::vector<std::size_t>& square : squares) {
    double sum = 0;
    for (const std::size_t i : square) sum += values[i];
    out.push_back(sum);
  }
  return out;
}

TrainingSamples Render(const CompiledScene& scene, const ReuseRival& rival,
                       const ReuseTrial& trial, const TrainingWork& work) {
  PlanOptions options = rival.options;
  options.auxiliary = Auxiliary::kNone;
  RunParameters run = MakeRunParameters(scene, MakePlan(scene, options));
  run.seed = trial.seed;
  run.tables = rival.tables;
  options.training = FeatureSet{};
  options.own_points = true;
  return RunTrainingPass(scene, options, run, work, trial.watcher);
}

bool Takes(const CompiledScene& scene, const ReuseRival& rival) {
  try {
    return MakePlan(scene, rival.options).features.Has(Feature::kReuse);
  } catch (const InputError&) {
    return false;  // it does not go together with all else
  }
}

}  // namespace

ReuseVerdict TryReuse(const CompiledScene& scene, const ReuseRival& usual,
                      const ReuseRival& reuse, const ReuseTrial& trial) {
  const TrainingWork work = MakeTileWork(scene, trial.samples, kSpp);
  const TrainingSamples plain = Render(scene, usual, trial, work);
  const TrainingSamples shared = Render(scene, reuse, trial, work);
  ReuseVerdict out;
  out.samples = plain.colors.size() + shared.colors.size();
  for (const TrainingSamples* of : {&plain, &shared}) {
    out.rays += of->rays_closest + of->rays_shadow;
  }
  const ImageGuess image(static_cast<std::uint32_t>(scene.film.width),
                         static_cast<std::uint32_t>(scene.film.height), work.pixels,
                         plain.colors);
  const std::vector<bool> counted = Counted(scene, usual, work);
  const auto tiles = Squares(scene, work, counted, kReuseTile);
  const auto squares = Squares(scene, work, counted, kSquare);
  const PilotMeasure of_plain = {plain.Cost(),
                                 Summed(RelativeVariances(plain, work, image), tiles)};
  const PilotMeasure of_shared = {kReusePrice * shared.Cost(),
                                  Summed(RelativeVariances(shared, work, image), tiles)};
  out.gain = GainOf(of_shared, of_plain);
  const PilotGain filtered =
      GainOf({of_shared.cost, VariancesOfMeans(shared, work, image, squares)},
             {of_plain.cost, VariancesOfMeans(plain, work, image, squares)});
  out.per_pixel = std::exp(out.gain.log);
  out.filtered = std::exp(filtered.log);
  const double clear = out.gain.least - kStandardErrors * out.gain.standard_error;
  out.pays_per_pixel = clear > std::log(kMustGain) && out.per_pixel > trial.must_gain;
  out.pays = out.pays_per_pixel && out.filtered > kMayLose;
  return out;
}

std::vector<TriedBlocks> TryBlocks(const CompiledScene& scene, const ReuseRival& usual,
                                   const ReuseTrial& trial) {
  std::vector<TriedBlocks> tried;
  for (const char* const changes : {"reuse=block", "reuse=block:32"}) {
    ReuseRival blocks = usual;
    blocks.options.Change(changes);
    if (!Takes(scene, blocks)) break;
    const ReuseVerdict verdict = TryReuse(scene, usual, blocks, trial);
    if (trial.watcher != nullptr && trial.watcher->PutsDown()) break;
    tried.push_back({changes, verdict});
    if (verdict.pays || !verdict.pays_per_pixel) break;
  }
  return tried;
}

}  // namespace lanelight
