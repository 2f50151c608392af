// What `lanelight bench` measures: which rows, how often, and where the time goes.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "src/base/core/error.h"
#include "src/measure/report/page.h"
#include "src/measure/throughput/throughput.h"
#include "src/measure/throughput/throughput_comparison.h"
#include "src/scene/parse/parse.h"
#include "tests/render/run/render_fixture.h"
#include "tests/support/test_target.h"

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
  return MeasureThroughput(options, stop, [](const BenchProgress&) { return true; });
}

}  // namespace

TEST_CASE("every built-in scene equals its file without comments", "[throughput]") {
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
    CHECK(row.seconds.size() >= std::size_t(kMinRepeats));
    const Interval rate = row.Rate();
    CHECK(rate.low <= rate.value);
    CHECK(rate.value <= rate.high);
  }
}

TEST_CASE("samples per pixel are fixed for each scene", "[throughput]") {
  ThroughputOptions options = SmallBench();
  options.settings.spp.reset();
  options.threads = {1};
  const BenchScene& scene = BenchScenes().at(0);
  const ThroughputRow row = Measure(options).at(0);
  CHECK(scene.name == options.scenes[0]);
  CHECK(row.spp == scene.spp);
  CHECK(row.counts.samples == row.spp * 16 * 16);
  CHECK(ToJson({row}, 1)["rows"][0]["spp"] == scene.spp);
  CHECK_THAT(ThroughputText({row}, 1, {}), Catch::Contains("spp"));
  CHECK(BenchSpp("a-file.pbrt") == kFileSpp);
}

TEST_CASE("rates are per second of the clock, and of processor time", "[throughput]") {
  ThroughputRow row = Measure(SmallBench()).at(0);
  row.seconds.assign(6, 2.0);
  row.cpu_seconds.assign(6, 0.5);
  CHECK(row.Rate().value == Approx(double(row.counts.samples) / 2));
  CHECK(row.CpuRate().value == Approx(double(row.counts.samples) * 2));
  row.waiting_seconds = 1;  // beside the 3 seconds of processor time
  CHECK(row.WaitingFraction() == Approx(0.25));
}

TEST_CASE("a busy machine is one whose load exceeds its cores, or where threads wait",
          "[throughput]") {
  MachineInfo machine;
  ThroughputRow row;
  row.cpu_seconds.assign(6, 1.0);
  CHECK(BusyReasons({row}, machine).empty());  // nothing is known of it
  machine.cores = 4;
  machine.load = 3.9;
  CHECK(BusyReasons({row}, machine).empty());
  machine.load = 4.1;
  CHECK_THAT(BusyReasons({row}, machine).at(0), Catch::Contains("4.10"));
  machine.load = 3;
  machine.quota = 2;
  CHECK(BusyReasons({row}, machine).size() == 1);
  machine.load = 0;
  row.waiting_seconds = 1;
  CHECK_THAT(BusyReasons({row}, machine).at(0), Catch::Contains("14 %"));
}

TEST_CASE("groups of stages account for all stage time", "[throughput]") {
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

TEST_CASE("efficiency is the rate relative to perfect scaling of one thread",
          "[throughput]") {
  const std::vector<ThroughputRow> rows = Measure(SmallBench());
  const nlohmann::json json = ToJson(rows, 1);
  const nlohmann::json& one = json["rows"][0]["parallel_efficiency"];
  CHECK(one["value"] == 1);
  CHECK(one["low"].is_null());
  const nlohmann::json& two = json["rows"][1]["parallel_efficiency"];
  const Interval ratio = RateRatioOf(rows[1].Rate(), rows[0].Rate());
  CHECK(two["value"].get<double>() == Approx(ratio.value / 2));
  CHECK(two["high"].get<double>() == Approx(ratio.high / 2));
  // Unknown without a row of one thread.
  CHECK(ToJson({rows[1]}, 1)["rows"][0]["parallel_efficiency"].is_null());
}

TEST_CASE("The page of a bench can be written", "[throughput][report]") {
  const std::string page =
      ReportPage(PageKind::kBench, ToJson(Measure(SmallBench()), 1e-9));
  CHECK(page.substr(0, 15) == "<!doctype html>");
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_BENCH");
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

TEST_CASE("a missing scene is an error", "[throughput]") {
  ThroughputOptions options = SmallBench();
  options.scenes = {"no-such-scene.pbrt"};
  CHECK_THROWS_AS(Measure(options), InputError);
}

}  // namespace lanelight::test
