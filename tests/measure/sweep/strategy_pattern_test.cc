// Patterns of strategies in a sweep file.
#include <catch2/catch.hpp>

#include "src/measure/sweep/sweep_file.h"
#include "src/vocabulary/strategy/choices.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

using Catch::Contains;

std::string TextsOf(const std::string& pattern) {
  std::string texts;
  for (const PatternStrategy& strategy : ExpandStrategy(pattern, {})) {
    texts += strategy.text + " ";
  }
  return texts;
}

Sweep SweepOf(const std::string& strategies, const std::string& more = "") {
  const TemporaryFolder folder;
  folder.Write("a.pbrt", "");
  return ParseSweep(folder.File("s.toml"), "[grid]\nscene = \"a.pbrt\"\nstrategy = [" +
                                               strategies + "]\n" + more);
}

}  // namespace

TEST_CASE("strategy pattern: every value in braces", "[sweep]") {
  CHECK(TextsOf("roulette=throughput:{0.01, 0.2}") ==
        "roulette=throughput:0.01 roulette=throughput:0.2 ");
  CHECK(TextsOf("points={stratified,halton},roulette=constant:{0.1,0.5}:2") ==
        "points=stratified,roulette=constant:0.1:2 "
        "points=stratified,roulette=constant:0.5:2 "
        "points=halton,roulette=constant:0.1:2 points=halton,roulette=constant:0.5:2 ");
  const auto all = ExpandStrategy("points=stratified,roulette=constant:{0.1}:2", {});
  CHECK(all[0].place.family == "points=stratified,roulette=constant:*:2");
  CHECK(all[0].place.parameters ==
        std::map<std::string, std::string>{{"roulette=constant", "0.1"}});
}

TEST_CASE("strategy pattern: a star is all choices", "[sweep]") {
  const auto all = ExpandStrategy("directions=bsdf,points=*", {});
  CHECK(all.size() == kNumSampleSequences);
  CHECK(all[1].text == "directions=bsdf,points=stratified");
  CHECK(all[1].place.parameters.at("points") == "stratified");
}

TEST_CASE("strategy pattern: without alternatives it is the strategy itself", "[sweep]") {
  const auto all = ExpandStrategy("points=stratified", {});
  REQUIRE(all.size() == 1);
  CHECK(all[0].text == "points=stratified");
  CHECK(all[0].place == StrategyPlace{"points=stratified", {}});
}

TEST_CASE("strategy pattern: mistakes are reported", "[sweep]") {
  const auto [text, message] = GENERATE(table<std::string, std::string>(
      {{"points={stratified", "'{' without"},
       {"points=stratified}", "'}' without"},
       {"points={stratified,,halton}", "is empty"},
       {"points={}", "is empty"},
       {"{stratified,halton}", "needs a key"},
       {"roulette=throughput:*", "numbers are listed"},
       {"*", "numbers are listed"},
       {"point=*", "did you mean \"points\"?"},
       {"c={1,2,3,4,5,6,7,8,9,0},c={1,2,3,4,5,6,7,8,9,0},c={1,2,3,4,5,6,7,8,9,0},"
        "c={1,2,3,4,5,6,7,8,9,0},c={1,2}",
        "more than 10000"}}));
  CHECK_THROWS_WITH(ExpandStrategy(text, {}), Contains(message));
}

TEST_CASE("strategy pattern: values are strategies of the grid", "[sweep]") {
  const Sweep sweep = SweepOf("\"default\", \"points={sobol,stratified}\"");
  REQUIRE(sweep.cells.size() == 2);  // Sobol' is the default
  CHECK(sweep.places.at("default").size() == 2);
  CHECK(sweep.places.at("points=stratified").size() == 1);
  CHECK(
      SweepOf("\"points=*\"", "[[exclude]]\nstrategy = \"points={stratified,halton}\"\n")
          .cells.size() == kNumSampleSequences - 2);
  CHECK_THROWS_WITH(SweepOf("\"roulette=constant:{0.5, 0.50}\""),
                    Contains("is a duplicate"));
  CHECK_THROWS_WITH(SweepOf("\"points=*\", \"points=stratified\""),
                    Contains("is a duplicate"));
  CHECK_THROWS_WITH(SweepOf("\"roulette=constant:{0.5, 2}\""),
                    Contains("3:13") && Contains("0.001 to 0.999"));
}

}  // namespace lanelight
