// What `lanelight bench` measures: which rows, how often, and where the time goes.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/support/test_target.h"
#include "src/core/error.h"
#include "src/parse/parse.h"
#include "src/throughput/bench_scenes.h"
#include "src/report/page.h"
#include "src/throughput/throughput.h"
#include "src/throughput/throughput_comparison.h"
#include "tests/run/render_fixture.h"

namespace lanelight::test {
namespace {

ThroughputOptions SmallBench() {
  ThroughputOptions options;
  options.scenes = {"cornell-box"};
  options.settings.resolution = {16, 16};
  options.settings.spp = 2;
  options.threads = {1, 2};
  options.targets = {TestTarget().name()};
  options.within = 1;
  options.seconds = 0.01;
  return options;
}

std::vector<ThroughputRow> Measure(const ThroughputOptions& options) {
  const std::atomic<bool> stop{false};
  return MeasureThroughput(options, stop, [](const BenchProgress&) {});
}

}  // namespace

TEST_CASE("every scene of the program is that of its file, without comments",
          "[throughput]") {
  for (const BenchScene& scene : BenchScenes()) {
    INFO(scene.name);
    TestRender small;
    small.spp = 1;
    SceneDescription own = ReadBenchScene(scene.name);
    SceneDescription file = ParseScene(std::string("scenes/") + scene.name + ".pbrt", {});
    for (SceneDescription* s : {&own, &file}) s->film.width = s->film.height = 24;
    CHECK(Identical(RenderDescription(own, small).film,
                    RenderDescription(file, small).film));
  }
}

TEST_CASE("rows are measured six times at least, with the samples asked for",
          "[throughput]") {
  const std::vector<ThroughputRow> rows = Measure(SmallBench());
  REQUIRE(rows.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const ThroughputRow& row = rows[i];
    CHECK(row.threads == int(i) + 1);
    CHECK(row.spp == 2);
    CHECK(row.counts.samples == 2 * 16 * 16);
    CHECK(row.seconds.size() >= std::size_t(kLeastRepeats));
    const Interval rate = row.Rate();
    CHECK(rate.low <= rate.value);
    CHECK(rate.value <= rate.high);
  }
}

TEST_CASE("without samples asked for, renders are made long enough", "[throughput]") {
  ThroughputOptions options = SmallBench();
  options.settings.spp.reset();
  options.threads = {1};
  const ThroughputRow row = Measure(options).at(0);
  CHECK(row.spp > 4);
  CHECK(row.counts.samples == row.spp * 16 * 16);
}

TEST_CASE("kinds of stages have all the time of stages", "[throughput]") {
  const ThroughputRow row = Measure(SmallBench()).at(0);
  double all = 0, groups = 0;
  for (const StageProfile& s : row.counts.stages) all += s.seconds;
  for (const StageProfile& s : row.counts.parts) all += s.seconds;
  for (const StageGroup& g : StageGroups(row)) {
    groups += 1e-9 * g.ns_per_sample * double(row.counts.samples);
    CHECK(g.Lanes() <= 1);
  }
  CHECK(groups == Approx(all));
}

TEST_CASE("efficiency is the rate over that of as many times one thread",
          "[throughput]") {
  const std::vector<ThroughputRow> rows = Measure(SmallBench());
  const nlohmann::json json = ToJson(rows);
  const nlohmann::json& one = json["rows"][0]["parallel_efficiency"];
  CHECK(one["value"] == 1);
  CHECK(one["low"].is_null());
  const nlohmann::json& two = json["rows"][1]["parallel_efficiency"];
  const Interval ratio = RateRatioOf(rows[1].Rate(), rows[0].Rate());
  CHECK(two["value"].get<double>() == Approx(ratio.value / 2));
  CHECK(two["high"].get<double>() == Approx(ratio.high / 2));
  // Without a row of one thread nobody knows.
  CHECK(ToJson({rows[1]})["rows"][0]["parallel_efficiency"].is_null());
}

TEST_CASE("The page of a bench can be written", "[throughput][report]") {
  const std::string page = BenchReportPage(ToJson(Measure(SmallBench())));
  CHECK(page.substr(0, 15) == "<!doctype html>");
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_BENCH");
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

TEST_CASE("a scene that is not there is an error", "[throughput]") {
  ThroughputOptions options = SmallBench();
  options.scenes = {"no-such-scene.pbrt"};
  CHECK_THROWS_AS(Measure(options), InputError);
}

}  // namespace lanelight::test
