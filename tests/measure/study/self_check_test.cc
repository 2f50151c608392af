// A study says how often the renders' own intervals held, counts renders of one seed as
// dependent, and names the strategies and the pixels where they did not.
#include <catch2/catch.hpp>

#include "src/measure/study/analysis.h"

namespace lanelight {
namespace {

using Catch::Matchers::Contains;

// A render whose interval holds or not; pixel (31, 5) is the worst where it does not.
Measurement Rendered(std::uint64_t seed, bool covers) {
  Measurement m;
  m.seed = seed;
  m.relmse = covers ? 1 : 3;
  m.self_relmse = 1, m.self_low = 0.9, m.self_high = 1.1;
  m.worst_share = covers ? 0.02 : 0.24;
  m.worst_x = covers ? seed : 31;
  m.worst_y = covers ? 1 : 5;
  return m;
}

struct Studied {
  SceneRuns runs;
  SceneAnalysis analysis;

  // Returns cells of a strategy whose render of seed i holds if `covers` says so.
  template <class Holds>
  void Add(const std::string& name, int seeds, const Holds& covers,
           double reference_share = 0) {
    std::vector<Measurement> renders;
    LevelAnalysis level;
    level.reference_share = reference_share;
    for (int i = 0; i < seeds; ++i) {
      renders.push_back(Rendered(static_cast<std::uint64_t>(i), covers(i)));
      ++level.self.total;
      level.self.inside += covers(i);
    }
    StrategyAnalysis strategy;
    strategy.levels.push_back(level);
    if (reference_share <= kMaxReferenceFraction) strategy.self.Add(renders);
    analysis.strategies.push_back(strategy);
    runs.strategies.emplace_back();
    runs.strategies.back().named.name = name;
  }
  std::string Text() {
    Calibrate(0.95, analysis);
    return CalibrationText(runs, analysis);
  }
};

}  // namespace

TEST_CASE("a strategy with too narrow intervals is reported with its pixels", "[study]") {
  Studied s;
  s.Add("good", 24, [](int i) { return i != 3; });
  s.Add("narrow", 24, [](int i) { return i % 8 < 3; });
  s.Add("other", 24, [](int i) { return i != 7; });
  const std::string text = s.Text();
  REQUIRE(s.analysis.self_failures.size() == 1);
  const SelfFailure& f = s.analysis.self_failures[0];
  CHECK(f.strategy == 1);
  CHECK(f.inside == 9);
  CHECK(f.total == 24);
  CHECK(f.worst_share == Approx(0.24));
  CHECK_THAT(text, Contains("For narrow, 9 of 24") && Contains("(31, 5)") &&
                       Contains("24 %") && !Contains("good") && !Contains("other"));
}

TEST_CASE("strategies with valid intervals are not reported", "[study]") {
  Studied s;
  for (int k = 0; k < 30; ++k) {
    s.Add("s" + std::to_string(k), 8, [&](int i) { return k != 5 || i > 0; });
  }
  CHECK_THAT(s.Text(), Contains("99.6 %") && Contains("of 240 renders (8 seeds"));
  CHECK(s.analysis.self_failures.empty());
}

TEST_CASE("renders that share seeds are not counted as independent", "[study]") {
  // Two seeds of 16 fail with all strategies, or as many renders of any seeds.
  const auto width = [](const auto& covers) {
    Studied s;
    for (int k = 0; k < 16; ++k) {
      s.Add("s" + std::to_string(k), 16, [&](int i) { return covers(k, i); });
    }
    s.Text();
    CHECK(s.analysis.calibration_share.value == Approx(14.0 / 16));
    CHECK(s.analysis.calibration_seeds == 16);
    return s.analysis.calibration_share.high - s.analysis.calibration_share.low;
  };
  const double together = width([](int, int i) { return i > 1; });
  const double apart = width([](int k, int i) { return (i + k) % 16 > 1; });
  CHECK(together > 3 * apart);
}

TEST_CASE("renders limited by the reference's error are not counted", "[study]") {
  Studied s;
  s.Add("good", 8, [](int) { return true; });
  s.Add("below the reference's noise", 8, [](int) { return false; }, 0.2);
  s.Text();
  CHECK(s.analysis.calibration.total == 8);
  CHECK(s.analysis.self_failures.empty());
}

}  // namespace lanelight
