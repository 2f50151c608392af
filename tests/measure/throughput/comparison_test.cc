// Rates of two measurements: ratios, their intervals, and what counts as slower.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <sstream>

#include "src/base/core/text_layout.h"
#include "src/measure/throughput/throughput.h"
#include "src/measure/throughput/throughput_comparison.h"
#include "src/vocabulary/strategy/strategy.h"

namespace lanelight::test {
namespace {

KnownThroughput Known(std::vector<Interval> rates) {
  KnownThroughput known = {"a machine", "a program", {}, {}, "", ""};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    known.rows.push_back(
        {"scene", "AVX2", "default", int(i) + 1, 64, 64, 16, rates[i], rates[i], "", ""});
  }
  return known;
}

void CheckFits(const std::string& text, std::size_t width) {
  INFO(text);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) CHECK(TextWidth(line) <= width);
}

KnownRow& Hash(KnownRow& row, const std::string& scene) {
  row.scene = row.label = row.scene_hash = scene;
  return row;
}

// Simulates benchmarks: `--within 0.01`, at most 20 repeats.
class SimulatedBench {
 public:
  enum Noise { kNormal, kHeavyTailed, kWide };
  // `busy`: other programs take a part of the processors in each run, up to half of them.
  // They slow down each row per processor second by up to 12 %, as measured here.
  SimulatedBench(Noise noise, bool busy) : noise_(noise), busy_(busy) {}

  // `seconds`: of each render without noise. The machine's speed changes between runs by
  // 0.3 %.
  KnownThroughput Run(double seconds) {
    seconds *= std::exp(0.003 * normal_(engine_));
    KnownThroughput known = Known({});
    if (busy_) known.busy = {"threads waited for a processor"};
    for (int i = 0; i < 10; ++i) {
      ThroughputRow row;
      row.counts.samples = 1000;
      const double others = busy_ ? uniform_(engine_) : 0;
      const auto width = [&] {
        const Interval s = stat::MedianInterval(row.cpu_seconds, kBenchConfidence);
        return row.cpu_seconds.size() < kMinRepeats ? 1 : (s.high - s.low) / s.value;
      };
      while (row.seconds.size() < 20 && width() > 0.02) {
        row.cpu_seconds.push_back(seconds * (1 + 0.12 * others) *
                                  std::exp(NoiseOfRender()));
        row.seconds.push_back(row.cpu_seconds.back() * (1 + others * uniform_(engine_)));
      }
      known.rows.push_back({"scene", "AVX2", "default", i + 1, 64, 64, 16, row.Rate(),
                            row.CpuRate(), "", ""});
    }
    return known;
  }

  // Returns how many comparisons with a program this much slower report it.
  int Reports(double slower, int comparisons) {
    int reports = 0;
    for (int i = 0; i < comparisons; ++i) {
      const RateComparison c = CompareRates(Run(1), Run(1 + slower));
      reports += c.Judge(kTolerance) == RateComparison::Verdict::kSlower;
    }
    return reports;
  }

 private:
  double NoiseOfRender() {
    if (noise_ == kNormal) return 0.006 * normal_(engine_);
    if (noise_ == kWide) return 0.02 * normal_(engine_);
    const bool disturbed = uniform_(engine_) < 0.1;
    return 0.006 * student_(engine_) + (disturbed ? 0.05 * slow_(engine_) : 0);
  }

  Noise noise_;
  bool busy_;
  std::mt19937_64 engine_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  std::student_t_distribution<double> student_{3};
  std::exponential_distribution<double> slow_;
};

// Equal programs raise few alarms, and 95 of 100 slower ones are reported.
void CheckAlarms(bool busy, double slower, double slower_if_wide) {
  using S = SimulatedBench;
  for (const auto noise : {S::kNormal, S::kHeavyTailed, S::kWide}) {
    INFO(noise);
    SimulatedBench bench(noise, busy);
    CHECK(bench.Reports(0, 1000) <= 5);
    CHECK(bench.Reports(noise == S::kWide ? slower_if_wide : slower, 100) >= 95);
  }
}

}  // namespace

TEST_CASE(
    "3 % slower is reported; 200 comparisons of equal programs raise one alarm at most",
    "[throughput]") {
  CheckAlarms(false, 0.03, 0.04);
}

TEST_CASE("a busy machine hides less than 30 % and raises one alarm in 200 at most",
          "[throughput]") {
  CheckAlarms(true, 0.3, 0.3);
  SimulatedBench bench(SimulatedBench::kNormal, true);
  const RateComparison c = CompareRates(bench.Run(1), bench.Run(1));
  CHECK(c.Judge(kTolerance) == RateComparison::Verdict::kNotSlower);
  CHECK_THAT(ComparisonText(c, Known({}), kTolerance, 200),
             Catch::Contains("Judged per processor second"));
}

TEST_CASE("a list has ratios of equal work, and marks other work", "[throughput]") {
  KnownThroughput reference = Known({{1e6, 9.9e5, 1.01e6}, {2e6, 1.9e6, 2.1e6}});
  for (KnownRow& row : reference.rows) Hash(row, "box");
  reference.name = "old";
  KnownThroughput fast = Known({{3e6, 2.9e6, 3.1e6}, {8e6, 7.9e6, 8.1e6}});
  for (KnownRow& row : fast.rows) Hash(row, "box");
  fast.rows[1].threads = 64;  // both are all cores
  fast.rows[1].target = "SVE2";
  const auto text = [&] { return ListText({fast, reference}, 1, 200); };
  CHECK_THAT(text(), Catch::Contains("3.00 [") && Catch::Contains("4.00 [") &&
                         !Catch::Contains("not comparable"));
  CheckFits(ListText({fast, reference}, 1, 60), 60);
  for (const int kind : {0, 1, 2, 3}) {
    KnownThroughput other = fast;
    KnownRow& row = other.rows[0];
    if (kind == 0) row.scene_hash = "another";
    if (kind == 1) row.spp = 1;
    if (kind == 2) row.height = 1;
    if (kind == 3) row.strategy = "roulette=none";
    const std::string marked = ListText({other, reference}, 1, 200);
    CHECK_THAT(marked, Catch::Contains("3*") && !Catch::Contains("3.00 [") &&
                           Catch::Contains("* not comparable"));
  }
}

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
  CHECK(GeometricMean({c.rows[0].ratio, {12, 12, 12}}).value == Approx(6));
}

TEST_CASE("rows of other scenes, samples, sizes or threads are refused", "[throughput]") {
  using Verdict = RateComparison::Verdict;
  const KnownThroughput before = Known({{100, 99, 101}});
  for (const int kind : {0, 1, 2, 3}) {
    KnownThroughput now = Known({{10, 9.9, 10.1}});
    if (kind == 0) now.rows[0].spp = 1;
    if (kind == 1) now.rows[0].width = 32;
    if (kind == 2) now.rows[0].threads = 2;
    if (kind == 3) now.rows[0].scene_hash = "of another file";
    const RateComparison c = CompareRates(before, now);
    CHECK(c.rows.empty());
    CHECK(c.refused.size() == 1);
    CHECK(c.Judge(0.05) == Verdict::kNotComparable);
    CHECK_THAT(ComparisonText(c, before, 0.05, 200),
               Catch::Contains("refused: ") && Catch::Contains("not comparable"));
  }
}

TEST_CASE("rates of a busy machine are judged per processor second", "[throughput]") {
  using Verdict = RateComparison::Verdict;
  KnownThroughput before = Known({{100, 99, 101}});
  KnownThroughput now = Known({{50, 49, 51}});
  CHECK(CompareRates(before, now).Judge(0.05) == Verdict::kSlower);
  CHECK(CompareRates(now, before).Judge(0.05) == Verdict::kNotSlower);
  before.busy = {"the load before the start, 5.00, exceeds the 2 cores of the machine"};
  const auto judge = [&](const Interval& cpu_rate, const char* words) {
    now.rows[0].cpu_rate = cpu_rate;
    const RateComparison c = CompareRates(before, now);
    CHECK_THAT(ComparisonText(c, before, 0.05, 200),
               Catch::Contains(words) && Catch::Contains("load"));
    return c.Judge(0.05);
  };
  CHECK(judge({100, 99, 101}, "slower by more than 17.4 %") == Verdict::kNotSlower);
  CHECK(judge({88, 87, 89}, "no row is slower") == Verdict::kNotSlower);
  CHECK(judge({80, 79, 81}, "slower: scene") == Verdict::kSlower);
  CHECK(judge({100, 80, 120}, "only a slowdown by more than") == Verdict::kNotComparable);
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
