// A trial concludes from the variances and costs that it has measured.
#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "src/render/train/path_records.h"
#include "src/render/train/strategy_trial.h"
#include "src/render/train/trial_comparison.h"
#include "tests/agreement/agreement.h"

namespace lanelight::test {
namespace {

TrialMeasure MeasureOf(double cost, double variance, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::exponential_distribution<double> scatter(1 / variance);
  TrialMeasure m;
  m.cost = cost;
  for (int i = 0; i < 2000; ++i) m.variances.push_back(scatter(engine));
  return m;
}

TrialGain GainOfFactor(double factor, double standard_error) {
  return {std::log(factor), standard_error, std::log(factor)};
}

// A change on tiles that gains so much by pixels and after a filter.
TriedOnTiles Judged(const char* changes, double per_pixel, double filtered,
                    double standard_error) {
  TriedOnTiles tried;
  tried.candidate = {changes, 1};
  tried.per_pixel = GainOfFactor(per_pixel, 0.05);
  tried.filtered = GainOfFactor(filtered, standard_error);
  tried.Judge(1);
  return tried;
}

}  // namespace

TEST_CASE("a loss after a filter counts if it is clear", "[decision]") {
  CHECK(Judged("reuse=block", 4.7, 0.92, 0.14).is_efficient);
  CHECK_FALSE(Judged("reuse=block", 4.7, 0.92, 0.02).is_efficient);
  CHECK_FALSE(Judged("reuse=block", 4.7, 0.67, 0.14).is_efficient);
  CHECK(Judged("reuse=block", 4.7, 0.96, 0).is_efficient);
  // Without a clear gain by pixels there is nothing to lose for.
  CHECK_FALSE(Judged("reuse=block", 1.02, 1.5, 0.1).is_efficient);
}

TEST_CASE("of path reuse, smaller blocks are used if they are slightly better",
          "[decision]") {
  const auto best = [](std::vector<TriedOnTiles> tried) {
    const TriedOnTiles* const found = BestOf(tried);
    return std::string(found == nullptr ? "" : found->candidate.changes);
  };
  const TriedOnTiles large = Judged("reuse=block", 4.7, 0.9, 0.2);
  CHECK(best({large, Judged("reuse=block:32", 4.6, 1.25, 0.2)}) == "reuse=block:32");
  CHECK(best({large, Judged("reuse=block:32", 4.6, 1, 0.2)}) == "reuse=block");
  // Another kind must be clearly better.
  CHECK(best({large, Judged("light-paths=splats", 4.6, 1.25, 0.2)}) == "reuse=block");
  CHECK(best({large, Judged("light-paths=splats", 6, 2, 0.2)}) == "light-paths=splats");
  CHECK(best({Judged("reuse=block", 1, 1, 0.2)}).empty());
}

TEST_CASE("one strategy is clearly better only by variance times cost", "[decision]") {
  const TrialMeasure baseline = MeasureOf(3, 1);
  // Planted: the cost, or the variance, left out would turn these around.
  CHECK_FALSE(IsClearlyBetter(MeasureOf(6, 0.7), baseline, 0.95));
  CHECK_FALSE(IsClearlyBetter(MeasureOf(2, 1.6), baseline, 0.95));
  CHECK(IsClearlyBetter(MeasureOf(6, 0.4), baseline, 0.95));
  CHECK(IsClearlyBetter(MeasureOf(2, 1.2), baseline, 0.95));
  CHECK_FALSE(IsClearlyBetter(baseline, MeasureOf(6, 0.4), 0.95));
  // Better by less than the margin.
  CHECK(IsClearlyBetter(MeasureOf(3, 0.9), baseline, 0.95));
  CHECK_FALSE(IsClearlyBetter(MeasureOf(3, 0.9), baseline, 0.87));
}

TEST_CASE("single pixels do not determine a gain", "[decision]") {
  const TrialMeasure baseline = MeasureOf(1, 1);
  TrialMeasure lucky = baseline, unlucky = MeasureOf(1, 0.8);
  TrialMeasure bright = baseline;
  bright.variances[700] = 1e6;
  CHECK_FALSE(IsClearlyBetter(lucky, bright, 0.95));
  unlucky.variances[31] = 1e6;
  CHECK(IsClearlyBetter(unlucky, baseline, 0.95));
  // One in twenty is the strategy's own.
  for (std::size_t i = 0; i < unlucky.variances.size(); i += 20) {
    unlucky.variances[i] = 100;
  }
  CHECK_FALSE(IsClearlyBetter(unlucky, baseline, 0.95));
  // Equal ones from other samples: a difference of chance, by two standard errors about
  // one time in fifty, and by 5 percent as well.
  int better = 0;
  for (unsigned seed = 2; seed < 102; ++seed) {
    better += IsClearlyBetter(MeasureOf(1, 1, seed), baseline, 0.95);
  }
  CHECK(better < 5);
}

TEST_CASE("gains include all pixels and their standard error", "[decision]") {
  const TrialMeasure baseline = MeasureOf(3, 1), other = MeasureOf(6, 0.7, 2);
  // Means of 2000 exponential variables each: a standard error of 0.032 together.
  const TrialGain gain = GainOf(other, baseline);
  CHECK(gain.standard_error == Approx(0.0316).epsilon(0.1));
  CHECK(std::abs(gain.log - std::log(3 / 4.2)) < 5 * gain.standard_error);
  CHECK(GainOf(baseline, other).log == Approx(-gain.log));
  CHECK(GainOf(baseline, baseline).log == 0);
  CHECK(GainOf(baseline, baseline).standard_error == 0);
  // Two pixels of 2000 carry most of the error. Planted: left out, as the worst
  // thousandth.
  TrialMeasure rare = MeasureOf(1, 1, 3);
  rare.variances[5] = rare.variances[1700] = 3000;
  const TrialGain of_rare = GainOf(MeasureOf(1, 1, 3), rare);
  CHECK(of_rare.log == Approx(std::log(4)).epsilon(0.1));
  CHECK(of_rare.standard_error > 0.4);
  // Nothing was seen of one, or of both.
  const TrialMeasure none = {1, std::vector<double>(2000)};
  CHECK(GainOf(none, none).log == 0);
  CHECK(GainOf(none, baseline).log > 10);
  CHECK(GainOf(baseline, none).log < -10);
}

TEST_CASE("a gain carried by few bright samples is not chosen", "[decision]") {
  TriedStrategy entry;
  entry.paired = true;
  entry.measure = MeasureOf(1, 1, 2);
  entry.baseline = MeasureOf(3, 1, 2);
  CHECK(entry.SignificantLogGain(1.05, 2) == Approx(std::log(3 / 1.05)));
  // Both have met the same bright samples: the gain is as large, and looks as sure.
  const auto bright = [&](std::size_t pixels) {
    for (std::size_t i = 0; i < pixels; ++i) {
      entry.measure.variances[90 * i] = entry.baseline.variances[90 * i] = 1e5;
    }
  };
  bright(3);
  CHECK(entry.Gain().log == Approx(std::log(3)).epsilon(0.1));
  CHECK(EffectivePixels(entry.measure.variances) == Approx(3).epsilon(0.1));
  CHECK(entry.IsCarriedByFew());
  CHECK(entry.SignificantLogGain(1.05, 2) == 0);
  bright(20);
  CHECK_FALSE(entry.IsCarriedByFew());
  CHECK_FALSE(entry.IgnoresWorstPixels());
  CHECK(entry.SignificantLogGain(1.05, 2) > 1);
  // No error at all is not carried by anything.
  entry.measure = {1, std::vector<double>(2000)};
  CHECK_FALSE(entry.IsCarriedByFew());
  CHECK(entry.SignificantLogGain(1.05, 2) > 10);
}

// Where few pixels carry the error, a roulette that is milder than the default is judged
// by all others. Planted: by the few as well; any other change as if it were one.
TEST_CASE("strategies that cannot vary more are compared without the worst pixels",
          "[decision]") {
  TriedStrategy entry;
  entry.measure = MeasureOf(1.2, 0.5, 2);
  entry.baseline = MeasureOf(1, 1, 2);
  // A bright sample that the baseline strategy has not met, though it may.
  entry.measure.variances[700] = 1e5;
  CHECK(entry.IsCarriedByFew());
  CHECK(entry.SignificantLogGain(1.05, 0.5) == 0);
  CHECK(entry.Gain().log < -2);
  entry.milder_roulette = true;
  CHECK(entry.IgnoresWorstPixels());
  CHECK(entry.SignificantLogGain(1.05, 0.5) ==
        Approx(std::log(1 / (1.2 * 0.5) / 1.05)).epsilon(0.02));
  // Not better, by all others either.
  entry.measure.cost = 2.2;
  CHECK(entry.SignificantLogGain(1.05, 0.5) == 0);
}

TEST_CASE("only the roulette is compared for milder roulettes", "[decision]") {
  const PreparedScene scene = PrepareScene(SplitRoom());
  const TrainingOptions training;
  const auto milder_roulette = [&](const std::string& baseline_changes,
                                   const std::string& changes) {
    PlanOptions options = WithChanges(scene, {}, baseline_changes);
    StrategyTrial trial(scene, training, 1, 1 << 16);
    TriedStrategy baseline = PrepareTrial(scene, options, "", 1);
    TriedStrategy tried = PrepareTrial(scene, options, changes, 1);
    trial.Begin(1024);
    REQUIRE(trial.Try(baseline, baseline));
    REQUIRE(trial.Try(tried, baseline));
    CHECK_FALSE(baseline.milder_roulette);
    return tried.milder_roulette;
  };
  CHECK(milder_roulette("", "roulette=throughput:0:2:4"));
  CHECK(milder_roulette("", "roulette=throughput:0.2"));
  CHECK_FALSE(milder_roulette("", "roulette=throughput:0:1"));
  CHECK_FALSE(milder_roulette("", "roulette=throughput:0:2:0.5"));
  CHECK_FALSE(milder_roulette("", "roulette=constant"));
  CHECK_FALSE(milder_roulette("", "roulette=adjoint"));
  CHECK_FALSE(milder_roulette("", "roulette=throughput:0:2:4,directions=bsdf"));
  CHECK_FALSE(milder_roulette("roulette=none", "roulette=throughput:0:2:4"));
}

TEST_CASE("variances of samples that depend on each other are of their observations",
          "[decision]") {
  // Pixels of four observations, whose samples take turns: all of one are the same.
  std::mt19937 engine(5);
  std::normal_distribution<float> normal(1, 0.25f);
  TrainingWork work;
  work.spp = 8;
  TrainingSamples samples;
  samples.observations = 4;
  for (std::uint32_t pixel = 0; pixel < 64 * 64; ++pixel) {
    work.pixels.push_back(pixel);
    float of_one[4];
    for (float& v : of_one) v = normal(engine);
    for (std::uint32_t k = 0; k < work.spp; ++k) {
      const float v = of_one[k % 4];
      samples.colors.push_back({v, v, v});
    }
  }
  const PilotImage image(64, 64, work.pixels, samples.colors);
  const double weight = 1 / (1 + 0.01);
  // Two samples of an observation are worth one. 2 sigma^4 / 3 is the variance of each
  // pixel's; six standard errors: 2e-9.
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0;
    for (double v : values) sum += v;
    return sum / double(values.size());
  };
  const double noise = 6 * std::sqrt(2.0 / 3 / (64 * 64)) + 0.02;
  CHECK(mean(RelativeVariances(samples, work, image)) ==
        Approx(2 * 0.0625 * weight).epsilon(noise));
  // The mean of 16 pixels that are independent has a sixteenth of that, and of pixels
  // that are one and the same as much as each.
  std::vector<std::size_t> square(16), one(16, 7);
  double of_means = 0;
  for (std::size_t first = 0; first < work.pixels.size(); first += 16) {
    std::iota(square.begin(), square.end(), first);
    of_means += VarianceOfMean(samples, work, image, square) / (64 * 64 / 16);
  }
  CHECK(of_means ==
        Approx(2 * 0.0625 * weight / 16).epsilon(6 * std::sqrt(2.0 / 3 / 256)));
  CHECK(VarianceOfMean(samples, work, image, one) ==
        Approx(VarianceOfMean(samples, work, image, std::span(one).first(1))));
  // Planted: as if all were independent.
  samples.observations = 8;
  CHECK(mean(RelativeVariances(samples, work, image)) <
        2 * 0.0625 * weight * (1 - 2 * noise));
}

}  // namespace lanelight::test
