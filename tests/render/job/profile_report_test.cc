// The rows of a profile from counts that are known, and the rule of the roofline.
#include "src/render/job/profile_report.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "src/render/wave/profile.h"

namespace lanelight {
namespace {

Peaks SomePeaks() {
  Peaks peaks;
  peaks.levels = {{"L1", 32 << 10, 16 << 10, 200e9},
                  {"L2", 1 << 20, 1 << 19, 100e9},
                  {"memory", std::size_t{1} << 34, 1 << 28, 10e9}};
  peaks.flops = 100e9;
  peaks.fma_ipc = 2;
  return peaks;
}

StageProfile StageOf(const std::string& name, double seconds, std::uint64_t items,
                     StageRole role = StageRole::kAccumulate) {
  StageProfile s;
  s.name = name;
  s.seconds = seconds;
  s.items = items;
  s.role = role;
  s.calls = 10;
  s.lane_slots = 2 * items;
  s.bytes_read = 24, s.bytes_written = 8, s.bytes_per_item = 32;
  return s;
}

RunResult SomeResult() {
  RunResult r;
  r.stages = {
      StageOf("camera", 0.1, 1000000),
      StageOf("visible: intersect_triangles", 0.4, 4000000, StageRole::kIntersect),
      StageOf("shadow_spheres", 0.2, 2000000, StageRole::kShadow),
      StageOf("connect", 0.2, 2000000)};
  r.parts = EmptyParts();
  r.parts[static_cast<std::size_t>(TaskPart::kFilm)].seconds = 0.05;
  r.parts[static_cast<std::size_t>(TaskPart::kFilm)].calls = 4;
  r.cpu_seconds = 1;
  r.bytes_in_flight = 1 << 19;
  return r;
}

// A row of one second, with the processor's counters per item.
ProfileRow CountedRow(double cycles, double instructions, double l1, double llc) {
  ProfileRow row;
  row.counts = StageOf("connect", 1, 10000000);
  row.counts.counted_items = 1000;
  row.counts.counted = {static_cast<std::uint64_t>(cycles * 1000),
                        static_cast<std::uint64_t>(instructions * 1000),
                        static_cast<std::uint64_t>(l1 * 1000),
                        static_cast<std::uint64_t>(llc * 1000)};
  return row;
}

ProfileReport ReportOf(const RunResult& result) {
  return MakeProfileReport({&result, 1}, SomePeaks());
}

Bound BoundOf(ProfileRow row) {
  const Peaks peaks = SomePeaks();
  PlaceOnRoofline(peaks, peaks.levels[1], row);
  return row.bound;
}

}  // namespace

TEST_CASE("a profile's rows add up to the processor time", "[profile]") {
  const ProfileReport report = ReportOf(SomeResult());
  CHECK(report.seconds == Approx(1));
  REQUIRE(report.rows.size() == 6);  // parts that never ran are left out
  double fractions = 0;
  for (std::size_t i = 0; i < report.rows.size(); ++i) {
    fractions += report.rows[i].fraction;
    if (i > 0) CHECK(report.rows[i].fraction <= report.rows[i - 1].fraction);
  }
  CHECK(fractions == Approx(1));
  CHECK(report.rows[0].counts.name == "visible: intersect_triangles");
  CHECK(report.rows[0].NsPerItem() == Approx(100));
  CHECK(report.rows[0].counts.Occupancy() == Approx(0.5));
  CHECK(report.intersect_seconds == Approx(0.6));
  CHECK(report.other_stage_seconds == Approx(0.3));
  CHECK(report.Ratio() == Approx(0.5));
  CHECK(report.RatioWithAll() == Approx(0.4 / 0.6));
  CHECK(report.level.name == "L2");
  CHECK(report.rows.back().fraction == Approx(0.05));
}

TEST_CASE("a profile without time or intersection has no ratio", "[profile]") {
  const ProfileReport empty = ReportOf({});
  CHECK(empty.Ratio() == 0);
  for (const ProfileRow& row : empty.rows) CHECK(row.fraction == 0);
}

TEST_CASE("repeats of a profile give medians with intervals", "[profile]") {
  std::vector<RunResult> repeats;
  for (const double factor : {1.0, 1.3, 1.1, 1.2, 1.05, 9.0}) {
    repeats.push_back(SomeResult());
    repeats.back().samples = 1000000;
    for (StageProfile& s : repeats.back().stages) s.seconds *= factor;
    repeats.back().cpu_seconds *= factor;
  }
  const ProfileReport report = MakeProfileReport(repeats, SomePeaks());
  const ProfileRow& row = report.rows[0];
  CHECK(row.counts.name == "visible: intersect_triangles");
  REQUIRE(row.ns_per_sample.size() == 6);
  CHECK(row.ns_per_sample[1] == Approx(520));
  const Interval median = MedianOf(row.ns_per_sample);
  CHECK(median.value == Approx(460));
  CHECK(median.low == Approx(400));
  CHECK(median.high == Approx(3600));
  CHECK(row.counts.seconds == Approx(0.46));
  CHECK(row.counts.items == 4000000);  // counts are of one render
  CHECK(report.ns_per_sample[5] == Approx(9000));
  // A stage that the first repeat does not have.
  repeats[1].stages.push_back(StageOf("late", 6, 1));
  const ProfileReport more = MakeProfileReport(repeats, SomePeaks());
  const auto late = std::find_if(more.rows.begin(), more.rows.end(),
                                 [](const auto& r) { return r.counts.name == "late"; });
  REQUIRE(late != more.rows.end());
  CHECK(late->ns_per_sample == std::vector<double>{0, 6000, 0, 0, 0, 0});
}

TEST_CASE("the groups of a profile add up its rows", "[profile]") {
  RunResult result = SomeResult();
  result.stages[0].group = result.stages[3].group = ProfileGroup::kCamera;
  result.stages[1].group = ProfileGroup::kVisibleLights;
  result.stages[2].group = ProfileGroup::kShadow;
  result.training.cpu_seconds = 0.01;
  const ProfileReport report = ReportOf(result);
  const auto fraction = [&](ProfileGroup group) {
    for (const ProfileRow& g : report.groups) {
      if (g.counts.group == group) return g.fraction;
    }
    return 0.0;
  };
  CHECK(report.groups[0].counts.group == ProfileGroup::kVisibleLights);
  CHECK(fraction(ProfileGroup::kCamera) == Approx(0.3));
  CHECK(fraction(ProfileGroup::kShadow) == Approx(0.2));
  CHECK(fraction(ProfileGroup::kFilm) == Approx(0.05));
  CHECK(fraction(ProfileGroup::kTraining) == Approx(0.01));
  CHECK(fraction(ProfileGroup::kOutside) == Approx(0.04));
  CHECK(report.groups[0].counts.Occupancy() == Approx(0.5));
}

TEST_CASE("phases and features decide the group of a stage", "[profile]") {
  const auto group = [](PhaseId phase, StageRole role, FeatureSet needs = {}) {
    Stage stage{};
    stage.role = role;
    stage.needs = needs;
    return GroupOf(phase, stage);
  };
  using enum PhaseId;
  CHECK(group(kPaths, StageRole::kIntersect) == ProfileGroup::kIntersect);
  CHECK(group(kPaths, StageRole::kShadow) == ProfileGroup::kShadow);
  CHECK(group(kPaths, StageRole::kEmission) == ProfileGroup::kLights);
  CHECK(group(kVisibleLights, StageRole::kIntersect) == ProfileGroup::kVisibleLights);
  CHECK(group(kFindEdges, StageRole::kCamera) == ProfileGroup::kVisibleLights);
  CHECK(group(kLightPaths, StageRole::kShade) == ProfileGroup::kLightPaths);
  CHECK(group(kPaths, StageRole::kRecord, {Feature::kLightPaths}) ==
        ProfileGroup::kLightPaths);
  CHECK(group(kPaths, StageRole::kRecord, {Feature::kReuseGlossy}) ==
        ProfileGroup::kReuse);
  CHECK(group(kBlock, StageRole::kBlock) == ProfileGroup::kReuse);
}

TEST_CASE("the bound of a stage is computed from measured values only", "[profile]") {
  // 10 M items of 32 bytes in a second: 0.32 GB/s, far below.
  CHECK(BoundOf(CountedRow(0, 0, 0, 0)) == Bound::kUnknown);
  CHECK(BoundOf(CountedRow(300, 300, 0, 0)) == Bound::kNeither);
  CHECK(BoundOf(CountedRow(300, 450, 0, 0)) == Bound::kCompute);  // IPC 1.5 of 2
  // 20 misses of 64 bytes per item: 12.8 GB/s, more than main memory has, little for L2.
  CHECK(BoundOf(CountedRow(300, 300, 20, 20)) == Bound::kMemory);
  CHECK(BoundOf(CountedRow(300, 300, 20, 0)) == Bound::kNeither);
  ProfileRow streaming = CountedRow(0, 0, 0, 0);
  streaming.counts.seconds = 0.005;  // 64 GB/s of 100
  CHECK(BoundOf(streaming) == Bound::kMemory);
  const Peaks peaks = SomePeaks();
  PlaceOnRoofline(peaks, peaks.levels[1], streaming);
  CHECK(streaming.bandwidth == Approx(64e9));
  CHECK(streaming.of_peak == Approx(0.64));
}

TEST_CASE("the stages that count as intersect are those of kernels/intersect",
          "[profile]") {
  namespace fs = std::filesystem;
  int checked = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(LANELIGHT_SOURCE_DIR "/kernels")) {
    if (entry.path().extension() != ".cc") continue;
    std::ifstream in(entry.path());
    std::stringstream text;
    text << in.rdbuf();
    const bool tracing = text.str().find("\"intersect_") != std::string::npos ||
                         text.str().find("\"shadow_") != std::string::npos;
    const bool place = entry.path().parent_path().filename() == "intersect";
    INFO(entry.path());
    CHECK(tracing == place);
    checked += tracing;
  }
  // Files; both stages of curves are in one, and those of all other shapes but triangles.
  CHECK(checked == 4);
}

}  // namespace lanelight
