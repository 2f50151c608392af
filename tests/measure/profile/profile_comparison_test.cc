// Comparisons of profiles with simulated times: what is found, and what is not.
#include "src/measure/profile/profile_comparison.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "src/base/core/text_layout.h"

namespace lanelight::test {
namespace {

using Json = nlohmann::json;

constexpr double kNoise = 0.01;  // standard deviation over the mean, of each repeat
constexpr int kStages = 30;

// A profile whose stage i takes 100 / (i + 1) ns per sample; stage `slow` takes `factor`
// times as long. On a busy machine, other programs add up to 12 % to the largest stages
// and up to 45 % to small ones, as measured.
Json Simulated(int seed, int slow = 0, double factor = 1, bool busy = false) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> noise(1, kNoise);
  std::uniform_real_distribution<double> others(0, 1);
  constexpr std::size_t repeats = 8;
  std::vector<double> totals(repeats);
  Json rows = Json::array();
  for (int i = 0; i < kStages; ++i) {
    std::vector<double> times;
    const double added = busy ? others(random) * (i < 3 ? 0.12 : 0.45) : 0;
    const double slowdown = (1 + added) * (i == slow ? factor : 1);
    for (double& total : totals) {
      times.push_back(100.0 / (i + 1) * noise(random) * slowdown);
      total += times.back();
    }
    rows.push_back({{"name", "stage" + std::to_string(i)},
                    {"kind", "stage"},
                    {"ns_per_sample_of_repeats", times}});
  }
  return {{"scene_hash", "hash"},
          {"target", {{"name", "AVX2"}}},
          {"strategy_in_force", "roulette=none"},
          {"threads", 1},
          {"resolution", {64, 64}},
          {"samples", 4096},
          {"busy", busy ? Json::array({"the load was 9"}) : Json::array()},
          {"rows", rows},
          {"ns_per_sample_of_repeats", totals}};
}

ProfileComparison Compared(const Json& before, const Json& now) {
  return CompareProfiles(before, now, 0.05);
}

bool IsSlower(const Json& before, const Json& now) {
  const ProfileComparison c = Compared(before, now);
  CHECK(c.problems.empty());
  return c.IsSlower();
}

}  // namespace

TEST_CASE("a planted slower stage is found", "[profile]") {
  int covered = 0;
  for (int seed = 0; seed < 50; ++seed) {
    const ProfileComparison c = Compared(Simulated(seed), Simulated(seed + 1000, 3, 1.3));
    REQUIRE(c.changes.size() == kStages + 1);
    CHECK(c.changes[0].name == "total");
    CHECK(c.changes[1].name == "stage3");  // the largest difference: 7.5 ns
    CHECK(c.changes[1].slower);
    covered += c.changes[1].difference.Contains(7.5);
    for (std::size_t i = 2; i < c.changes.size(); ++i) CHECK_FALSE(c.changes[i].slower);
    CHECK(std::abs(c.changes[2].difference.value) >=
          std::abs(c.changes[3].difference.value));
  }
  CHECK(covered >= 44);  // 95 % of 50, less three standard deviations
}

TEST_CASE("equal profiles are not reported", "[profile]") {
  int alarms = 0;
  for (int seed = 0; seed < 200; ++seed) {
    // Without a tolerance only the test and the least change decide.
    alarms += CompareProfiles(Simulated(seed), Simulated(seed + 1000), 0).IsSlower();
    CHECK_FALSE(IsSlower(Simulated(seed), Simulated(seed + 1000)));
  }
  CHECK(alarms <= 10);  // 5 % of all comparisons; half of them are faster
}

TEST_CASE("profiles of a busy machine are judged by processor time", "[profile]") {
  int alarms = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Json before = Simulated(seed, 0, 1, true);
    alarms += IsSlower(before, Simulated(seed + 1000, 0, 1, true));
    const ProfileComparison c = Compared(before, Simulated(seed + 1000, 2, 2, true));
    CHECK(std::ranges::any_of(c.changes, [](const StageChange& change) {
      return change.name == "stage2" && change.slower;
    }));
  }
  CHECK(alarms <= 1);
  const std::string text =
      ComparisonText(Compared(Simulated(1), Simulated(2, 0, 1, true)), 0.05, 12, 400);
  CHECK_THAT(text,
             Catch::Contains(
                 "slower by more than 20 %, and no stage by more than 55 %. Judged by") &&
                 Catch::Contains("this run: the load was 9"));
  Json noisy = Simulated(2, 0, 1, true);
  for (const std::size_t i : {0, 2, 4, 6}) {
    Json& total = noisy["ns_per_sample_of_repeats"][i];
    total = 2 * total.get<double>();
  }
  CHECK_THAT(
      ComparisonText(Compared(Simulated(1), noisy), 0.05, 12, 400),
      Catch::Contains("not comparable") && Catch::Contains("could have been found"));
}

TEST_CASE("small and faster changes are not slower", "[profile]") {
  CHECK_FALSE(IsSlower(Simulated(1), Simulated(2, 0, 1.03)));
  CHECK_FALSE(IsSlower(Simulated(1), Simulated(2, 0, 0.5)));
  // A stage of 0.8 % of the time that doubles is below the least change.
  CHECK_FALSE(IsSlower(Simulated(1), Simulated(2, 29, 2)));
  Json now = Simulated(2);
  for (Json& total : now["ns_per_sample_of_repeats"]) total = 1.1 * total.get<double>();
  CHECK(Compared(Simulated(1), now).changes[0].slower);
}

TEST_CASE("a stage that one profile lacks has no time there", "[profile]") {
  Json before = Simulated(1);
  before["rows"][0]["name"] = "old";
  const ProfileComparison c = Compared(before, Simulated(2));
  REQUIRE(c.changes.size() == kStages + 2);
  CHECK(c.changes[1].difference.value * c.changes[2].difference.value < 0);
  CHECK(c.IsSlower());  // stage0 is new
}

TEST_CASE("profiles of other renders are not compared", "[profile]") {
  const Json before = Simulated(1);
  // Returns whether there are differences to print.
  const auto refused = [&](const char* member, const Json& value, const char* words) {
    Json now = Simulated(2, 0, 2);
    now[member] = value;
    const ProfileComparison c = Compared(before, now);
    CHECK_FALSE(c.IsSlower());
    CHECK_FALSE(c.problems.empty());
    CHECK_THAT(ComparisonText(c, 0.05, 12, 200),
               Catch::Contains(words) && Catch::Contains("not comparable"));
    return !c.changes.empty();
  };
  CHECK_FALSE(refused("scene_hash", "other", "other scene files"));
  CHECK_FALSE(refused("target", {{"name", "SSE2"}}, "\"SSE2\", before \"AVX2\""));
  CHECK_FALSE(refused("threads", 2, "threads: 2, before 1"));
  CHECK_FALSE(refused("samples", 1, "samples: 1, before 4096"));
  CHECK_FALSE(refused("strategy_in_force", "roulette=luminance",
                      "strategy: \"roulette=luminance\", before \"roulette=none\""));
  CHECK(refused("ns_per_sample_of_repeats", {300.0}, "1 repeats, intervals need 6"));
}

TEST_CASE("the text of a comparison fits and names slower stages", "[profile]") {
  const ProfileComparison c = Compared(Simulated(1), Simulated(2, 20, 3));
  const std::string text = ComparisonText(c, 0.05, 5, 90);
  INFO(text);
  CHECK_THAT(text, Catch::Contains("slower: stage20 +") && Catch::Contains("SLOWER"));
  std::istringstream in(text);
  int lines = 0;
  for (std::string line; std::getline(in, line); ++lines) CHECK(TextWidth(line) <= 90);
  CHECK(lines <= 9);
}

}  // namespace lanelight::test
