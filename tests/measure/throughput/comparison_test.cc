// Rates of two measurements: ratios, their intervals, and what counts as slower.
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "src/base/core/text_layout.h"
#include "src/measure/throughput/throughput.h"
#include "src/measure/throughput/throughput_comparison.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::test {
namespace {

KnownThroughput Known(std::vector<Interval> rates) {
  KnownThroughput known = {"a machine", "a program", {}, {}};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    known.rows.push_back(
        {"scene", "AVX2", "default", int(i) + 1, 64, 64, 16, rates[i], rates[i]});
  }
  return known;
}

void CheckFits(const std::string& text, std::size_t width) {
  INFO(text);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) CHECK(TextWidth(line) <= width);
}

}  // namespace

TEST_CASE("half widths of the logarithms of two rates add as squares", "[throughput]") {
  const RateComparison c = CompareRates(Known({{100, 90, 110}}), Known({{50, 45, 56}}));
  REQUIRE(c.rows.size() == 1);
  const Interval& ratio = c.rows[0].ratio;
  CHECK(ratio.value == Approx(0.5));
  CHECK(std::log(ratio.value / ratio.low) ==
        Approx(std::hypot(std::log(50.0 / 45), std::log(110.0 / 100))));
  CHECK(std::log(ratio.high / ratio.value) ==
        Approx(std::hypot(std::log(56.0 / 50), std::log(100.0 / 90))));
}

TEST_CASE("a row is slower if the loss is significant and above the tolerance",
          "[throughput]") {
  const KnownThroughput before = Known({{100, 99, 101}});
  const auto regresses = [&](Interval now) {
    return CompareRates(before, Known({now})).rows[0].Regresses(0.05);
  };
  CHECK(regresses({90, 89, 91}));
  CHECK_FALSE(regresses({97, 96.5, 97.5}));  // within the tolerance
  CHECK_FALSE(regresses({90, 70, 105}));     // not certain
  CHECK_FALSE(regresses({110, 109, 111}));
}

TEST_CASE("rows that only one measurement has are listed, not compared", "[throughput]") {
  const RateComparison c =
      CompareRates(Known({{1, 1, 1}, {2, 2, 2}}), Known({{3, 3, 3}}));
  CHECK(c.rows.size() == 1);
  REQUIRE(c.only_in_one.size() == 1);
  CHECK(c.only_in_one[0] == "scene, AVX2, 2 threads, 64x64, 16 spp, default");
  CHECK(c.Mean() == Approx(3));
}

TEST_CASE("rows of other samples, sizes or threads are refused", "[throughput]") {
  using Verdict = RateComparison::Verdict;
  const KnownThroughput before = Known({{100, 99, 101}});
  for (const int kind : {0, 1, 2}) {
    KnownThroughput now = Known({{10, 9.9, 10.1}});
    if (kind == 0) now.rows[0].spp = 1;
    if (kind == 1) now.rows[0].width = 32;
    if (kind == 2) now.rows[0].threads = 2;
    const RateComparison c = CompareRates(before, now);
    CHECK(c.rows.empty());
    CHECK(c.refused.size() == 1);
    CHECK(c.Judge(0.05) == Verdict::kNotComparable);
    CHECK_THAT(ComparisonText(c, before, 0.05, 200),
               Catch::Contains("refused: ") && Catch::Contains("not comparable"));
  }
}

TEST_CASE("rates of a busy machine are not compared", "[throughput]") {
  using Verdict = RateComparison::Verdict;
  KnownThroughput before = Known({{100, 99, 101}});
  const KnownThroughput now = Known({{50, 49, 51}});
  CHECK(CompareRates(before, now).Judge(0.05) == Verdict::kSlower);
  CHECK(CompareRates(now, before).Judge(0.05) == Verdict::kNotSlower);
  before.busy = {"the load before the start, 5.00, exceeds the 2 cores of the machine"};
  for (const auto& c : {CompareRates(before, now), CompareRates(now, before)}) {
    CHECK(c.Judge(0.05) == Verdict::kNotComparable);
    CHECK_THAT(ComparisonText(c, before, 0.05, 200),
               Catch::Contains("not comparable") && Catch::Contains("load"));
  }
}

TEST_CASE("rows are identified by the non-default parts of their strategy",
          "[throughput]") {
  KnownRow row = Known({{1, 1, 1}}).rows[0];
  Strategy strategy;
  row.strategy = ToText(strategy);
  CHECK(row.Key() == "scene, AVX2, 1 thread, 64x64, 16 spp");
  strategy.roulette = Roulette::kNone;
  row.strategy = ToText(strategy);
  CHECK(row.Key() == "scene, AVX2, 1 thread, 64x64, 16 spp, roulette=none");
}

TEST_CASE("texts of a bench fit with and without medians", "[throughput]") {
  ThroughputRow row;
  row.scene = "scene";
  row.target = "AVX2";
  row.threads = 1;
  for (const std::vector<double>& seconds :
       {std::vector<double>(6, 1.0), std::vector<double>{1, 2, 3, 4, 5, 60}}) {
    row.seconds = seconds;
    CheckFits(ThroughputText({row}, 1e-4, {false, 72}), 72);
  }
  KnownThroughput before = Known({{100, 99, 101}, {50, 49, 51}});
  before.machine = "a machine whose name is long, 128 cores, 1024 GiB, load 5.17, shared";
  const KnownThroughput now = Known({{90, 89, 91}});
  CheckFits(ComparisonText(CompareRates(before, now), before, 0.05, 72), 72);
}

}  // namespace lanelight::test
