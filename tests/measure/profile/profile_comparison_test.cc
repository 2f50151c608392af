// Comparisons of profiles with simulated times: what is found, and what is not.
#include "src/measure/profile/profile_comparison.h"

#include <catch2/catch.hpp>
#include <random>
#include <sstream>

#include "src/base/core/text_layout.h"

namespace lanelight::test {
namespace {

using Verdict = ProfileComparison::Verdict;

constexpr double kNoise = 0.01;  // standard deviation over the mean, of each repeat
constexpr int kStages = 30;

// A profile whose stage i takes 100 / (i + 1) ns per sample; stage `slow` takes `factor`
// times as long.
KnownProfile Simulated(int seed, int slow = 0, double factor = 1, int repeats = 8) {
  KnownProfile known{"a machine", "a program", "hash", "AVX2", "roulette=none", 1, 64, 64,
                     4096,        {},          {},     {}};
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> noise(1, kNoise);
  known.ns_per_sample.resize(static_cast<std::size_t>(repeats));
  for (int i = 0; i < kStages; ++i) {
    KnownProfile::Row& row =
        known.rows.emplace_back(KnownProfile::Row{"stage" + std::to_string(i), true, {}});
    for (double& total : known.ns_per_sample) {
      row.ns_per_sample.push_back(100.0 / (i + 1) * noise(random) *
                                  (i == slow ? factor : 1));
      total += row.ns_per_sample.back();
    }
  }
  return known;
}

ProfileComparison Compared(const KnownProfile& before, const KnownProfile& now) {
  return CompareProfiles(before, now, 0.05);
}

}  // namespace

TEST_CASE("a planted slower stage is found", "[profile]") {
  int covered = 0;
  for (int seed = 0; seed < 50; ++seed) {
    const ProfileComparison c = Compared(Simulated(seed), Simulated(seed + 1000, 3, 1.3));
    CHECK(c.Judge() == Verdict::kSlower);
    CHECK(c.stages[0].name == "stage3");  // the largest difference: 7.5 ns
    CHECK(c.stages[0].slower);
    covered += c.stages[0].difference.Contains(7.5);
    for (std::size_t i = 1; i < c.stages.size(); ++i) CHECK_FALSE(c.stages[i].slower);
    CHECK(std::abs(c.stages[1].difference.value) >=
          std::abs(c.stages[2].difference.value));
  }
  CHECK(covered >= 44);  // 95 % of 50, less three standard deviations
}

TEST_CASE("equal profiles are not reported", "[profile]") {
  int alarms = 0;
  for (int seed = 0; seed < 200; ++seed) {
    // Without a tolerance only the test decides.
    const ProfileComparison c =
        CompareProfiles(Simulated(seed), Simulated(seed + 1000), 0);
    alarms += c.Judge() != Verdict::kNotSlower;
    CHECK(Compared(Simulated(seed), Simulated(seed + 1000)).Judge() ==
          Verdict::kNotSlower);
  }
  CHECK(alarms <= 10);  // 5 % of all comparisons; half of them are faster
}

TEST_CASE("small and faster changes are not slower", "[profile]") {
  CHECK(Compared(Simulated(1), Simulated(2, 0, 1.03)).Judge() == Verdict::kNotSlower);
  CHECK(Compared(Simulated(1), Simulated(2, 0, 0.5)).Judge() == Verdict::kNotSlower);
  // A stage of 0.8 % of the time that doubles is below kMinChange.
  CHECK(Compared(Simulated(1), Simulated(2, 29, 2)).Judge() == Verdict::kNotSlower);
  // All stages 10 % slower: the total is, too.
  KnownProfile now = Simulated(2);
  for (double& total : now.ns_per_sample) total *= 1.1;
  CHECK(Compared(Simulated(1), now).total.slower);
}

TEST_CASE("a stage that one profile lacks has no time there", "[profile]") {
  KnownProfile before = Simulated(1), now = Simulated(2);
  before.rows[0].name = "old";
  const ProfileComparison c = Compared(before, now);
  CHECK(c.stages.size() == kStages + 1);
  CHECK(c.stages[0].difference.value * c.stages[1].difference.value < 0);
  CHECK(c.Judge() == Verdict::kSlower);  // stage0 is new
}

TEST_CASE("profiles of other renders or busy machines are not compared", "[profile]") {
  const KnownProfile before = Simulated(1);
  const auto refused = [&](auto change, const char* words) {
    KnownProfile now = Simulated(2, 0, 2);
    change(now);
    const ProfileComparison c = Compared(before, now);
    CHECK(c.Judge() == Verdict::kNotComparable);
    CHECK_THAT(ComparisonText(c, before, 0.05, 12, 200), Catch::Contains(words));
    return c.same_render;
  };
  CHECK_FALSE(refused([](auto& p) { p.scene_hash = "other"; }, "the scene files differ"));
  CHECK_FALSE(refused([](auto& p) { p.target = "SSE2"; }, "SSE2, before AVX2"));
  CHECK_FALSE(refused([](auto& p) { p.threads = 2; }, "threads is 2, before 1"));
  CHECK_FALSE(refused([](auto& p) { p.samples = 1; }, "samples is 1, before 4096"));
  CHECK_FALSE(refused([](auto& p) { p.strategy = "roulette=luminance"; },
                      "the strategy is roulette=luminance, before roulette=none"));
  CHECK(
      refused([](auto& p) { p.busy = {"the load was 9"}; }, "this run: the load was 9"));
  CHECK(refused([](auto& p) { p = Simulated(2, 0, 2, 5); }, "need 6 repeats, not 5"));
}

TEST_CASE("the text of a comparison fits and names slower stages", "[profile]") {
  const KnownProfile before = Simulated(1);
  const ProfileComparison c = Compared(before, Simulated(2, 20, 3));
  const std::string text = ComparisonText(c, before, 0.05, 5, 90);
  INFO(text);
  CHECK_THAT(text, Catch::Contains("slower: stage20 +") && Catch::Contains("SLOWER"));
  std::istringstream in(text);
  int lines = 0;
  for (std::string line; std::getline(in, line); ++lines) CHECK(TextWidth(line) <= 90);
  CHECK(lines <= 14);
}

}  // namespace lanelight::test
