// `lanelight advise` gives the same advice each time, agrees with decide=pilot, and
// advises what is more efficient.
#include "src/measure/advise/advise.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "src/base/core/parallel.h"
#include "src/render/train/strategy_trial.h"

namespace lanelight {
namespace {

Job JobOf(const std::string& scene, const std::string& size, std::uint64_t seed = 0) {
  RenderSettings settings;
  settings.spp = 1;
  settings.seed = seed;
  settings.decision = DefaultDecision::kNever;
  const std::size_t x = size.find('x');
  settings.resolution = {std::stoi(size.substr(0, x)), std::stoi(size.substr(x + 1))};
  return PrepareJob(std::string(LANELIGHT_SOURCE_DIR) + "/scenes/" + scene, settings);
}

Advice AdviceOf(const std::string& scene, double pilot, std::uint64_t seed = 0) {
  Job job = JobOf(scene, "64x48", seed);
  AdviceOptions options;
  options.seconds = 10;
  options.pilot = pilot;
  return Advise(job, options);
}

const AdvisedCandidate& Find(const Advice& advice, const std::string& changes) {
  for (const AdvisedCandidate& c : advice.candidates) {
    if (c.changes == changes) return c;
  }
  FAIL("no candidate " << changes);
  return advice.candidates.front();
}

// Without what the clock says.
nlohmann::json AdviceJson(const Advice& advice) {
  nlohmann::json json = ToJson(advice);
  json.erase("pilot_seconds");
  return json;
}

}  // namespace

TEST_CASE("advice is a function of scene, settings and seed", "[advise]") {
  const nlohmann::json one = [] {
    const ThreadLimit limit(1);
    return AdviceJson(AdviceOf("cornell-box.pbrt", 0.1, 5));
  }();
  CHECK(AdviceJson(AdviceOf("cornell-box.pbrt", 0.1, 5)) == one);
  CHECK(AdviceJson(AdviceOf("cornell-box.pbrt", 0.1, 6)) != one);
}

TEST_CASE("candidates beyond the trial's time are skipped, and --pilot extends it",
          "[advise]") {
  const auto skipped = [](const Advice& advice) {
    int count = 0;
    for (const AdvisedCandidate& c : advice.candidates) {
      count += c.status == CandidateStatus::kSkipped;
    }
    return count;
  };
  const Advice little = AdviceOf("cornell-box.pbrt", 0.1);
  CHECK(skipped(little) > 0);
  CHECK(little.candidates.front().samples > 0);
  CHECK(little.seconds_to_try > 0.1);
  const Advice enough = AdviceOf("cornell-box.pbrt", 1.1 * little.seconds_to_try);
  CHECK(skipped(enough) == 0);
  const Advice none = AdviceOf("cornell-box.pbrt", 1e-3);
  CHECK(none.chosen == Strategy());
  CHECK_THAT(none.why, Catch::Contains("too short"));
}

TEST_CASE("the trial takes its stated fraction of the time", "[advise]") {
  for (const double pilot : {0.3, 1.0}) {
    const Advice advice = AdviceOf("cornell-box.pbrt", pilot);
    CHECK(double(advice.rays) < 1.5 * pilot * kRaysPerSecond);
  }
}

TEST_CASE("more efficient strategies are advised, less efficient ones are not",
          "[advise]") {
  // Roulette ends most paths of a white room where all that shines is met late.
  const Advice room = AdviceOf("closed-room.pbrt", 0.6);
  INFO(ToJson(room).dump(1));
  CHECK((room.chosen.roulette == Roulette::kNone || room.chosen.First() == 5 ||
         room.chosen.scale > 1));
  const Advice box = AdviceOf("cornell-box.pbrt", 0.6);
  INFO(ToJson(box).dump(1));
  CHECK(box.chosen.roulette == Roulette::kThroughput);
  CHECK(Find(box, "roulette=none").efficiency.value < 1);
  CHECK(Find(box, "light-selection=tree").status == CandidateStatus::kRefused);
  for (const Advice* advice : {&room, &box}) {
    for (const AdvisedCandidate& c : advice->candidates) {
      if (c.samples == 0 || c.changes.empty()) continue;
      CHECK(c.efficiency.low < c.efficiency.value);
      CHECK(c.efficiency.value < c.efficiency.high);
    }
  }
}

TEST_CASE("a strategy that misses light is not advised", "[advise]") {
  TriedStrategy entry;
  entry.baseline = {1, std::vector<double>(1000, 1.0)};
  entry.measure = {1, std::vector<double>(1000, 0.01)};
  entry.baseline_light = {100, 1};
  entry.light = {99, 0.1};
  CHECK(entry.SignificantLogGain(kMinChangeGain, 1.645) ==
        Approx(std::log(100 / kMinChangeGain)));
  entry.light.sum = 96;
  CHECK(entry.MissesLight());
  CHECK(entry.SignificantLogGain(kMinChangeGain, 1.645) == 0);
  // More than that may be the baseline strategy's lack.
  entry.light.sum = 104;
  CHECK_FALSE(entry.MissesLight());
}

TEST_CASE("an interrupted trial keeps the default strategy", "[advise]") {
  Job job = JobOf("cornell-box.pbrt", "64x48");
  const std::atomic<bool> stop = true;
  AdviceOptions options;
  options.seconds = 10;
  options.stop = &stop;
  const Advice advice = Advise(job, options);
  CHECK(advice.interrupted);
  CHECK(advice.chosen == Strategy());
}

TEST_CASE("an uncertain efficiency is not stated", "[advise]") {
  CHECK_FALSE(IsUncertain(WithoutBounds(1)));
  CHECK_FALSE(IsUncertain({1.5, 0.8, 2.5}));
  CHECK(IsUncertain({2, 3.1e-46, 1.1e3}));
  Advice advice;
  advice.candidates = {{Strategy{}, "", ""}, {Strategy{}, "roulette=none", ""}};
  for (AdvisedCandidate& c : advice.candidates) c.samples = 100;
  advice.candidates[1].efficiency = {2, 3.1e-46, 1.1e3};
  const nlohmann::json json = ToJson(advice);
  CHECK(json["candidates"][0]["efficiency"]["value"] == 1);
  CHECK(json["candidates"][1]["efficiency"].is_null());
}

}  // namespace lanelight
