// What a ranking is not to be believed for: few samples, ranks that change, a busy
// machine.
#include <catch2/catch.hpp>
#include <cmath>

#include "src/measure/study/analysis.h"
#include "tests/base/stat/simulate.h"

namespace lanelight {
namespace {

using Catch::Contains;

// At 4, 16 and 64 samples; the relative MSE falls with their power `slope`.
StrategyAnalysis Simulated(double error_at_64, double slope, std::uint64_t seed) {
  reference::Random random(seed);
  StrategyAnalysis s;
  for (const std::uint64_t spp : {4, 16, 64}) {
    LevelAnalysis level;
    level.spp = spp;
    level.repetitions = 8;
    const double error = error_at_64 * std::pow(double(spp) / 64, slope);
    level.relmse = {error, error, error};
    stat::Level costs;
    costs.samples = double(spp);
    for (int i = 0; i < 8; ++i) {
      costs.error.push_back(error * (1 + 0.01 * stat::Normal(random)));
      costs.seconds.push_back(double(spp));
      if (spp == 64) s.trimmed.push_back({costs.error.back(), double(spp)});
    }
    s.levels.push_back(level);
    s.costs.push_back(costs);
  }
  s.at = 2;
  return s;
}

struct Simulation {
  SceneRuns runs;
  StudyOptions options;
  SceneAnalysis analysis;

  explicit Simulation(std::vector<StrategyAnalysis> strategies) {
    for (std::size_t i = 0; i < strategies.size(); ++i) {
      runs.strategies.push_back(
          {{std::string(1, char('a' + i)), {}}, RunStatus::kOk, "", {4, 16, 64}});
    }
    options.repetitions = 8;
    analysis.strategies = std::move(strategies);
    CompareStrategies(runs, options, analysis);
  }
  std::vector<std::string> Texts() const { return Cautions(runs, options, analysis); }
};

}  // namespace

TEST_CASE("a ranking confirmed by all levels gets no caution", "[study]") {
  const Simulation s({Simulated(0.02, -1, 1), Simulated(0.01, -1, 2)});
  CHECK(s.Texts().empty());
}

TEST_CASE("ranks that change with the sample count are reported", "[study]") {
  // The second is better from 29 samples on.
  const Simulation s({Simulated(0.02, -0.6, 1), Simulated(0.0145, -1, 2)});
  const auto texts = s.Texts();
  REQUIRE(texts.size() == 1);
  CHECK_THAT(texts[0],
             Contains("at 16 samples per pixel a is more efficient than b, at 64"));
}

TEST_CASE("a ranking after few samples gets a caution, unless the error is small",
          "[study]") {
  Simulation s({Simulated(0.02, -1, 1), Simulated(0.01, -1, 2)});
  for (StrategyAnalysis& strategy : s.analysis.strategies) strategy.at = 1;
  const auto texts = s.Texts();
  REQUIRE(texts.size() == 1);
  CHECK_THAT(texts[0], Contains("at 16 samples per pixel") && Contains("28 %"));
  for (StrategyAnalysis& strategy : s.analysis.strategies) {
    strategy.levels[1].relmse = {0.009, 0.009, 0.009};
  }
  CHECK(s.Texts().empty());
}

TEST_CASE("a machine whose load exceeds its cores gets a caution", "[study]") {
  Simulation s({Simulated(0.02, -1, 1), Simulated(0.01, -1, 2)});
  MachineInfo machine;
  machine.cores = 2;
  machine.load = 1.5;
  s.analysis.machines = {machine};
  CHECK(s.Texts().empty());
  s.analysis.machines[0].load = 7.25;
  const auto texts = s.Texts();
  REQUIRE(texts.size() == 1);
  CHECK_THAT(texts[0], Contains("load 7.25, 2 cores"));
}

}  // namespace lanelight
