// `lanelight profile` from the outside: the table, the JSON, the trace, what it refuses.
#include <catch2/catch.hpp>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/cli/exit_codes.h"
#include "tests/cli/process.h"
#include "tests/support/json.h"

namespace lanelight {
namespace {

using Catch::Contains;
using test::ReadJson;
using Json = nlohmann::json;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

ProcessResult Profile(const std::string& scene, std::vector<std::string> flags) {
  std::vector<std::string> arguments = {"profile", scene, "--quiet"};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  ProcessOptions options;
  options.columns = "100";
  const ProcessResult r = RunLanelight(arguments, options);
  INFO(r.err);
  REQUIRE(r.exit_code == kExitGood);
  return r;
}

// Microseconds in a trace have three decimals: compare in nanoseconds.
long long Nanoseconds(const Json& value) {
  return std::llround(1e3 * value.get<double>());
}

// Checks the events of every track; returns how many there are per track.
std::map<int, int> CheckTracks(const Json& trace, double run_seconds) {
  std::map<int, int> events;
  std::map<int, long long> ends;
  for (const Json& e : trace) {
    if (e.at("ph") != "X") continue;
    const int thread = e.at("tid");
    const long long begin = Nanoseconds(e.at("ts")), length = Nanoseconds(e.at("dur"));
    REQUIRE(begin >= ends[thread]);  // in order, without overlap, after the start
    REQUIRE(length >= 0);
    REQUIRE(e.at("pid") == 1);
    REQUIRE((e.at("cat") == "stage" || e.at("cat") == "task"));
    ends[thread] = begin + length;
    ++events[thread];
  }
  // The scale of the ticks is measured in the run itself.
  for (const auto& [thread, end] : ends) CHECK(double(end) * 1e-9 <= run_seconds * 1.01);
  return events;
}

}  // namespace

TEST_CASE("profile prints a table that fits into 100 columns", "[cli]") {
  TempDirectory directory;
  const ProcessResult r = Profile(WriteSphereScene(directory), {});
  CHECK(r.err.empty());
  for (const char* word :
       {"stage", "share", "ns/item", "items", "calls", "lanes", "read", "write", "GB/s",
        "bound", "peaks", "intersect_spheres", "outside stages", "film", "total",
        "time of other stages / time of intersection: ", "16 samples"}) {
    CHECK_THAT(r.out, Contains(word));
  }
  double last = 100, sum = 0;
  int rows = 0;
  bool table = false;
  for (const std::string& line : Lines(r.out)) {
    if (line.rfind("scene", 0) != 0) CHECK(line.size() <= 100);
    if (line.rfind("total", 0) == 0) break;
    if (table) {
      const double fraction = std::stod(line.substr(line.find('%') - 6, 6));
      CHECK(fraction <= last);
      last = fraction;
      sum += fraction;
      ++rows;
    }
    table |= line.rfind("stage ", 0) == 0;
  }
  CHECK(rows > 10);
  CHECK(sum == Approx(100).margin(0.05 * rows));  // each rounded to a tenth
}

TEST_CASE("the JSON of a profile has the same values with more digits", "[cli]") {
  TempDirectory directory;
  const std::string json = directory / "p.json";
  Profile(WriteSphereScene(directory),
          {"--json", json, "--spp", "8", "--threads", "2", "--seed", "3"});
  const Json p = ReadJson(json);
  CHECK(p.at("schema") == 1);
  CHECK(p.at("kind") == "profile");
  CHECK(p.at("samples") == 32 * 24 * 8);
  CHECK(p.at("threads") == 2);
  CHECK(p.at("seed") == 3);
  CHECK(p.at("stopped_early") == false);
  double fractions = 0, seconds = 0;
  for (const Json& row : p.at("rows")) {
    INFO(row);
    fractions += row.at("share").get<double>();
    seconds += row.at("seconds").get<double>();
    if (row.at("kind") != "stage") continue;
    CHECK(row.at("calls") > 0);
    CHECK(row.at("occupancy") > 0);
    CHECK(row.at("occupancy") <= 1);
    CHECK(row.at("peak_flops_per_item") > 0);
    CHECK(row.at("ns_per_item").get<double>() * row.at("items").get<double>() ==
          Approx(1e9 * row.at("seconds").get<double>()));
    const double bytes = row.at("bytes_read_per_item").get<double>() +
                         row.at("bytes_written_per_item").get<double>();
    CHECK(
        row.at("bytes_per_second").get<double>() ==
        Approx(bytes * row.at("items").get<double>() / row.at("seconds").get<double>()));
  }
  CHECK(fractions == Approx(1));
  CHECK(seconds == Approx(p.at("seconds").at("threads").get<double>()));
  CHECK(p.at("seconds").at("threads").get<double>() >=
        0.999 * p.at("seconds").at("cpu").get<double>());
  CHECK(p.at("other_stages_over_intersect").get<double>() ==
        Approx(p.at("seconds").at("other_stages").get<double>() /
               p.at("seconds").at("intersect").get<double>()));
  REQUIRE(p.at("peaks").at("levels").size() >= 3);
  CHECK(p.at("peaks").at("flops") > 0);
  const Json& counters = p.at("counters");
  if (!counters.at("available").get<bool>()) {
    CHECK_THAT(counters.at("note").get<std::string>(), Contains("perf_event_open"));
  }
  CHECK(p.at("trace").at("events") == 0);
}

TEST_CASE("profile and render choose the same strategy for equal arguments", "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string profile = directory / "p.json", render = directory / "r.json";
  // So many samples that a render of them begins with a trial run.
  const std::vector<std::string> amount = {"--resolution", "256x192", "--spp", "192"};
  std::vector<std::string> arguments = {"render", scene, "-o", directory / "out.exr",
                                        "--json", render};
  arguments.insert(arguments.end(), amount.begin(), amount.end());
  REQUIRE(RunLanelight(arguments).exit_code == kExitGood);
  std::vector<std::string> flags = amount;
  flags.insert(flags.end(), {"--json", profile});
  const ProcessResult r = Profile(scene, flags);
  const Json rendered = ReadJson(render), profiled = ReadJson(profile);
  CHECK(profiled.at("strategy") == rendered.at("settings").at("strategy"));
  CHECK_THAT(profiled.at("strategy"), Contains("decide=pilot"));
  std::vector<std::string> names, rows;
  for (const Json& stage : rendered.at("stages")) names.push_back(stage.at("name"));
  bool has_pilot = false;
  for (const Json& row : profiled.at("rows")) {
    if (row.at("kind") == "stage") rows.push_back(row.at("name"));
    has_pilot |= row.at("kind") == "pilot";
  }
  std::sort(names.begin(), names.end());
  std::sort(rows.begin(), rows.end());
  CHECK(names == rows);
  CHECK(has_pilot);
  CHECK_THAT(Lines(r.out).at(0), Contains("strategy") && Contains("trial run"));

  const ProcessResult explicit_run = Profile(scene, {"--strategy", "points=halton"});
  CHECK_THAT(Lines(explicit_run.out).at(0),
             Contains("points=halton") && !Contains("trial run"));
}

TEST_CASE("the rows of a profile account for the processor time", "[cli]") {
  TempDirectory directory;
  const std::string json = directory / "p.json";
  Profile(WriteSphereScene(directory),
          {"--json", json, "--spp", "64", "--resolution", "192x144", "--threads", "1"});
  for (const Json& row : ReadJson(json).at("rows")) {
    if (row.at("kind") == "outside") CHECK(row.at("share") < 0.05);
  }
}

TEST_CASE("JSON to standard output replaces the table", "[cli]") {
  TempDirectory directory;
  const ProcessResult r = Profile(WriteSphereScene(directory), {"--json", "-"});
  CHECK(Json::parse(r.out).at("kind") == "profile");
}

TEST_CASE("a trace has one track per thread, without overlaps", "[cli]") {
  TempDirectory directory;
  const std::string trace = directory / "t.json", json = directory / "p.json";
  Profile(WriteSphereScene(directory),
          {"--trace", trace, "--json", json, "--threads", "2", "--resolution", "96x72"});
  const Json events = ReadJson(trace), profile = ReadJson(json);
  REQUIRE(events.is_array());
  const auto tracks =
      CheckTracks(events, profile.at("seconds").at("render").get<double>());
  CHECK(tracks.size() >= 1);
  CHECK(tracks.size() <= 2);
  std::map<std::string, long> calls;
  long total = 0;
  int named = 0;
  for (const Json& e : events) {
    if (e.at("ph") == "X") ++calls[e.at("name")], ++total;
    named += e.at("name") == "thread_name";
    CHECK(e.at("ph") != "i");  // nothing was dropped
  }
  CHECK(named == static_cast<int>(tracks.size()));
  CHECK(total == profile.at("trace").at("events"));
  CHECK(profile.at("trace").at("dropped") == 0);
  for (const Json& row : profile.at("rows")) {
    if (row.at("calls") == 0) continue;
    INFO(row.at("name"));
    CHECK(calls[row.at("name")] == row.at("calls"));
  }
}

TEST_CASE("a full trace buffer reports the dropped events", "[cli]") {
  TempDirectory directory;
  const std::string trace = directory / "t.json", json = directory / "p.json";
  const ProcessResult r = Profile(
      WriteSphereScene(directory),
      {"--trace", trace, "--trace-events", "5", "--json", json, "--threads", "1"});
  const Json events = ReadJson(trace), profile = ReadJson(json);
  const long dropped = profile.at("trace").at("dropped");
  CHECK(profile.at("trace").at("events") == 5);
  CHECK(dropped > 0);
  CHECK_THAT(r.err, Contains(std::to_string(dropped) + " events"));
  CHECK(events.back().at("ph") == "i");
  CHECK(events.back().at("args").at("dropped") == dropped);
  CHECK_THAT(events.back().at("name").get<std::string>(),
             Contains(std::to_string(dropped)));
}

TEST_CASE("a full disk loses the trace, not the table", "[cli]") {
  TempDirectory directory, temporary;
  ProcessOptions options;
  options.temp_directory = temporary.path();
  options.file_size_limit = 2000;
  const ProcessResult r = RunLanelight({"profile", WriteSphereScene(directory), "--quiet",
                                        "--trace", directory / "t.json"},
                                       options);
  CHECK(r.exit_code == kExitBadInput);
  CHECK_THAT(r.err, Contains("t.json"));
  CHECK_THAT(r.out, Contains("time of other stages / time of intersection"));
  CHECK(directory.Files() == std::vector<std::string>{"sphere.pbrt"});
  CHECK(temporary.Files().empty());
}

TEST_CASE("Ctrl-C keeps the profile measured so far", "[cli]") {
  TempDirectory directory;
  const std::string json = directory / "p.json";
  ProcessOptions interrupt;
  interrupt.trigger = "rendering";
  interrupt.action = [](int child) { kill(child, SIGINT); };
  const ProcessResult r =
      RunLanelight({"profile", WriteSphereScene(directory), "--spp", "1000",
                    "--resolution", "640x480", "--json", json},
                   interrupt);
  INFO(r.err);
  CHECK(r.exit_code == kExitGood);
  CHECK_THAT(r.out, Contains("stopped early") &&
                        Contains("time of other stages / time of intersection"));
  const Json p = ReadJson(json);
  CHECK(p.at("stopped_early") == true);
  CHECK(p.at("samples") > 0);
  CHECK(p.at("samples") < 640 * 480 * 1000);
}

}  // namespace lanelight
