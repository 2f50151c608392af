// Stated intervals hold: over many seeds, the error against a converged image lies inside
// the render's interval about as often as stated. Where samples cannot bound the error,
// no interval is stated.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/base/stat/distributions.h"
#include "src/render/estimate/estimate.h"
#include "src/scene/parse/parse.h"
#include "tests/render/run/render_fixture.h"

namespace lanelight {
namespace {

constexpr int kSize = 24;
// Of a check, for a coverage in [0.9, 0.99], or of what lower ends promise.
constexpr double kFalseAlarm = 1e-6;

SceneDescription Scene(const std::string& path, int max_depth) {
  SceneDescription scene = ParseScene(path, {});
  scene.film.width = scene.film.height = kSize;
  scene.integrator.max_depth = max_depth;
  return scene;
}
SceneDescription CornellBox() { return Scene("scenes/cornell-box.pbrt", 4); }

// The true error of a render; the reference's own squared error is subtracted.
struct TrueError {
  double mse = 0, relmse = 0;

  TrueError(const FilmAccumulator& film, const FilmAccumulator& reference) {
    constexpr double kValues = 3.0 * kSize * kSize;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const Rgb m = film.Mean(x, y), r = reference.Mean(x, y);
        const Rgb v = reference.Variance(x, y);
        for (int c = 0; c < 3; ++c) {
          const double square = (m[c] - r[c]) * (m[c] - r[c]) - v[c];
          mse += square / kValues;
          relmse += square / (r[c] * r[c] + kRelativeEpsilon) / kValues;
        }
      }
    }
  }
};

// The ends moved to `times` their distance from the value, as ratios.
Interval Widened(const Interval& v, double times) {
  return {v.value, v.value * std::pow(v.low / v.value, times),
          v.value * std::pow(v.high / v.value, times)};
}

// P(X <= k) of X successes in n trials of probability p (A&S 26.5.24).
double AtMost(int k, int n, double p) {
  if (k < 0) return 0;
  return k >= n ? 1 : stat::BetaI(double(n - k), double(k + 1), 1 - p);
}

// Counts of intervals that held.
struct IntervalCoverage {
  int total = 0, covered = 0, halves = 0;

  void Add(const Interval& stated, double truth) {
    ++total;
    covered += stated.Contains(truth);
    halves += Widened(stated, 0.5).Contains(truth);
  }
  bool OftenEnough() const { return AtMost(covered, total, 0.9) >= kFalseAlarm; }
  // Normal logarithms (F with hundreds of degrees of freedom) that are 99 % inside the
  // interval are 80.2 % inside half of it: 2.576 / 2 deviations.
  bool NotTooOften() const { return 1 - AtMost(halves - 1, total, 0.803) >= kFalseAlarm; }
};

struct Tally {
  int renders = 0, refused = 0;
  int lower_covered = 0;  // of those refused
  IntervalCoverage relmse, rmse;
  // With mistakes: single samples for replicates, a part of the error left out, intervals
  // thrice as wide, nothing but the scatter of normal pixels.
  IntervalCoverage ungrouped, without_tail, wide, normal;

  void Add(const Rendered& r, const FilmAccumulator& reference, std::uint64_t spp) {
    const TrueError truth(r.film, reference);
    const ErrorEstimate e = EstimateError(r.film);
    ++renders;
    if (e.rmse.HasBounds()) rmse.Add(e.rmse, std::sqrt(std::max(0.0, truth.mse)));
    if (!e.relmse.HasBounds()) {
      ++refused;
      lower_covered += e.relmse.low <= truth.relmse;
      return;
    }
    const Interval& v = e.relmse;
    relmse.Add(v, truth.relmse);
    without_tail.Add({v.value / 1.3, v.low / 1.3, v.high / 1.3}, truth.relmse);
    wide.Add(Widened(v, 3), truth.relmse);
    // Replicates of g stratified samples taken for g times as many observations.
    const double g = double(spp) / double(r.film.Observations(0, 0));
    const double k1 = e.effective_pixels;
    ungrouped.Add(ErrorInterval(v.value * g, k1, k1 * (double(spp) - 1)), truth.relmse);
    const double freedom = double(r.film.Observations(0, 0) - 1);
    normal.Add(ErrorInterval(v.value, k1, k1 * freedom), truth.relmse);
  }
};

Tally Measure(const SceneDescription& scene, TestRender t, int seeds,
              const FilmAccumulator& reference) {
  Tally tally;
  for (int seed = 1; seed <= seeds; ++seed) {
    t.seed = static_cast<std::uint64_t>(seed);
    tally.Add(RenderDescription(scene, t), reference, t.spp);
  }
  UNSCOPED_INFO(tally.renders << " renders, " << tally.refused
                              << " refused, held: relmse " << tally.relmse.covered
                              << ", half " << tally.relmse.halves << ", rmse "
                              << tally.rmse.covered << ", half " << tally.rmse.halves
                              << ", without tail " << tally.without_tail.covered
                              << ", ungrouped " << tally.ungrouped.covered << ", wide "
                              << tally.wide.halves << ", normal " << tally.normal.covered
                              << ", lower ends " << tally.lower_covered);
  return tally;
}

FilmAccumulator LongRender(const SceneDescription& scene, std::uint64_t spp) {
  TestRender t;
  t.sampler = SampleSequence::kSobol;
  t.spp = spp;
  t.seed = 12345;
  return RenderDescription(scene, t).film;
}

TestRender WithSampler(SampleSequence sampler, std::uint64_t spp) {
  TestRender t;
  t.sampler = sampler;
  t.spp = spp;
  return t;
}

}  // namespace

TEST_CASE("the Cornell box states its error", "[study]") {
  const SceneDescription scene = CornellBox();
  const FilmAccumulator reference = LongRender(scene, 2048);
  for (SampleSequence sampler : {SampleSequence::kIndependent, SampleSequence::kSobol}) {
    const Tally tally = Measure(scene, WithSampler(sampler, 32), 120, reference);
    CHECK(tally.refused * 5 <= tally.renders);
    for (const IntervalCoverage& covered : {tally.relmse, tally.rmse}) {
      CHECK(covered.OftenEnough());
      CHECK(covered.NotTooOften());
    }
    // Each mistake is found.
    CHECK_FALSE(tally.without_tail.OftenEnough());
    CHECK_FALSE(tally.wide.NotTooOften());
    if (sampler == SampleSequence::kSobol) CHECK_FALSE(tally.ungrouped.OftenEnough());
  }
}

TEST_CASE("the error interval includes directly visible light edges", "[study]") {
  const SceneDescription scene = CornellBox();
  const FilmAccumulator reference = LongRender(scene, 4096);
  TestRender t = WithSampler(SampleSequence::kIndependent, 32);
  t.strategy = "seen-lights=paths";
  const Tally tally = Measure(scene, t, 120, reference);
  CHECK(tally.refused * 20 <= tally.renders);
  CHECK(tally.relmse.OftenEnough());
  CHECK_FALSE(tally.normal.OftenEnough());
}

TEST_CASE("with rare bright samples the interval is valid or omitted", "[study]") {
  const SceneDescription scene = Scene("scenes/lights.pbrt", 6);
  const FilmAccumulator reference = LongRender(scene, 4096);
  const Tally tally =
      Measure(scene, WithSampler(SampleSequence::kIndependent, 16), 300, reference);
  CHECK(tally.refused > 0);
  CHECK(tally.relmse.OftenEnough());
  // Half as wide, they do not.
  CHECK(AtMost(tally.relmse.halves, tally.relmse.total, 0.9) < kFalseAlarm);
  CHECK(AtMost(tally.lower_covered, tally.refused, kEstimateConfidence) >= kFalseAlarm);
}

TEST_CASE("the Cornell box states its error, at length", "[study][slow]") {
  const SceneDescription scene = CornellBox();
  const FilmAccumulator reference = LongRender(scene, 32768);
  for (SampleSequence sampler :
       {SampleSequence::kIndependent, SampleSequence::kSobol, SampleSequence::kHalton}) {
    for (std::uint64_t spp : {16, 50, 128}) {
      INFO(spp << " spp");
      const Tally tally = Measure(scene, WithSampler(sampler, spp), 200, reference);
      CHECK(tally.refused * 5 <= tally.renders);
      CHECK(tally.relmse.OftenEnough());
      CHECK(tally.rmse.OftenEnough());
    }
  }
}

}  // namespace lanelight
