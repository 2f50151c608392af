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
#include "tests/support/json_schema.h"

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

Json Schema() { return ReadJson(LANELIGHT_SOURCE_DIR "/docs/profile.schema.json"); }

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

TEST_CASE("profile prints at most 40 lines that fit the terminal", "[cli]") {
  TempDirectory directory;
  const ProcessResult r = Profile(WriteSphereScene(directory), {"--threads", "1"});
  INFO(r.out);
  CHECK(r.err.empty());
  const std::vector<std::string> lines = Lines(r.out);
  CHECK(lines.size() <= 40);
  CHECK(lines[0].rfind("Strategy points=independent, 16 spp, 1 thread, ", 0) == 0);
  std::string one_line = r.out;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  for (const char* words :
       {" takes ", " us per sample, ", " rays.", " group ", " stage ", " intersect ",
        "ns/item", "##", "% elsewhere; all stages with -v"}) {
    CHECK_THAT(one_line, Contains(words));
  }
  for (const std::string& line : lines) CHECK(line.size() <= 100);
  double sum = 0;
  bool table = false;
  for (const std::string& line : lines) {
    if (table && line.empty()) break;
    if (table) sum += std::stod(line.substr(line.find('%') - 6, 6));
    table |= line.rfind("group ", 0) == 0;
  }
  CHECK(sum == Approx(100).margin(1));
  CHECK_THAT(r.out, !Contains("bound") && !Contains("GB/s"));
}

TEST_CASE("profile -v prints all stages in tables that fit into 100 columns", "[cli]") {
  TempDirectory directory;
  const ProcessResult r = Profile(WriteSphereScene(directory), {"-v"});
  for (const char* word :
       {"stage", "share", "ns/item", "items", "calls", "lanes", "read", "write", "GB/s",
        "peaks", "intersect_spheres", "outside stages", "film",

        "16 spp", "bounce", "closest rays", "Lambertian diffuse material", "machine"}) {
    CHECK_THAT(r.out, Contains(word));
  }
  double last = 100, sum = 0;
  int rows = 0;
  bool table = false;
  for (const std::string& line : Lines(r.out)) {
    if (line.rfind("scene", 0) != 0) CHECK(line.size() <= 100);
    if (table && line.empty()) break;
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

TEST_CASE("repeats add intervals, and a profile is compared with an earlier one",
          "[cli]") {
  TempDirectory directory;
  const std::string scene = WriteSphereScene(directory);
  const std::string path = directory / "p.json", csv = directory / "p.csv";
  const std::vector<std::string> flags = {"--threads", "1", "--spp", "4"};
  std::vector<std::string> first = flags;
  first.insert(first.end(), {"--repeat", "6", "--json", path, "--csv", csv});
  const ProcessResult r = Profile(scene, first);
  CHECK_THAT(r.out, Contains("6 repeats") && Contains(" [") && Contains("]"));
  Json profile = ReadJson(path);
  CHECK(profile.at("repeats") == 6);
  CHECK(profile.at("rows")[0].at("ns_per_sample_of_repeats").size() == 6);
  std::ifstream in(csv);
  std::size_t lines = 0;
  for (std::string line; std::getline(in, line);) ++lines;
  CHECK(lines == profile.at("rows").size() + 1);

  const auto compare = [&](double factor, std::vector<std::string> more) {
    Json old = profile;
    old["busy"] = Json::array();
    for (Json& row : old["rows"]) {
      for (Json& ns : row["ns_per_sample_of_repeats"]) ns = factor * ns.get<double>();
    }
    for (Json& ns : old["ns_per_sample_of_repeats"]) ns = factor * ns.get<double>();
    std::vector<std::string> all = {"profile", scene, "--quiet", "--against",
                                    WriteText(directory / "old.json", old.dump())};
    all.insert(all.end(), flags.begin(), flags.end());
    all.insert(all.end(), more.begin(), more.end());
    return RunLanelight(all);
  };
  // On a machine so busy that nothing can be judged, the program says so.
  const auto check = [](const ProcessResult& result, int code, const char* words) {
    INFO(result.out);
    const bool busy = result.out.find("could have been found") != std::string::npos;
    CHECK(result.exit_code == (busy ? kExitNotComparable : code));
    CHECK_THAT(result.out, Contains(busy ? "not comparable" : words));
  };
  const std::string html = directory / "p.html";
  check(compare(1e-3, {"--html", html}), kExitSlower, "slower: ");
  std::ifstream page(html);
  const std::string text((std::istreambuf_iterator<char>(page)), {});
  CHECK_THAT(text, Contains("\"against\":\"old.json\"") && Contains("\"queues\""));
  CHECK(compare(1, {"--html", path}).exit_code == kExitUsage);  // ends in .json
  check(compare(1e3, {}), kExitGood, "the total is not slower");
  const ProcessResult other = compare(1, {"--strategy", "points=halton"});
  CHECK(other.exit_code == kExitNotComparable);
  CHECK_THAT(other.out, Contains("points=halton"));
  const ProcessResult few = compare(1, {"--repeat", "2"});
  CHECK(few.exit_code == kExitNotComparable);
  CHECK_THAT(few.out, Contains("not comparable"));

  const std::string broken = WriteText(directory / "broken.json", "{}");
  const ProcessResult wrong = RunLanelight({"profile", scene, "--against", broken});
  CHECK(wrong.exit_code == kExitBadInput);
  CHECK_THAT(wrong.err, Contains("was not written by `lanelight profile --json`"));
  CHECK(RunLanelight({"profile", scene, "--repeat", "0"}).exit_code == kExitUsage);
}

TEST_CASE("the schema of a profile finds errors", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "p.json";
  Profile(WriteSphereScene(directory), {"--spp", "1", "--json", path});
  Json profile = ReadJson(path);
  const auto errors = test::SchemaErrors(Schema(), profile);
  INFO(Json(errors).dump(1));
  CHECK(errors.empty());
  profile["new"] = 1;
  profile.erase("kind");
  profile["rows"][0]["share"] = "half";
  profile["rows"][0]["bound"] = "unknown";
  CHECK(test::SchemaErrors(Schema(), profile).size() == 4);
}

TEST_CASE("the bounces of a profile have all its rays", "[cli]") {
  TempDirectory directory;
  const std::string path = directory / "p.json";
  Profile(WriteSphereScene(directory), {"--json", path, "--threads", "1"});
  const Json profile = ReadJson(path);
  double rays = 0, seconds = 0;
  for (const Json& bounce : profile.at("bounces")) {
    rays += bounce.at("rays_closest").get<double>();
    rays += bounce.at("rays_shadow").get<double>();
    seconds += bounce.at("seconds").get<double>();
    CHECK(bounce.at("occupancy") <= 1);
  }
  const double samples = profile.at("samples");
  CHECK(profile.at("bounces")[0].at("rays_closest").get<double>() >= samples);
  CHECK(rays <= 1.001 * samples * profile.at("rays_per_sample").get<double>());
  CHECK(seconds > 0);
  CHECK(seconds < profile.at("seconds").at("cpu"));
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
  CHECK_THAT(r.out.substr(0, 200), Contains("trategy") && Contains("trial run"));

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
  int named = 0, counters = 0;
  for (const Json& e : events) {
    if (e.at("ph") == "X") ++calls[e.at("name")], ++total;
    named += e.at("name") == "thread_name";
    counters += e.at("ph") == "C";
    CHECK(e.at("ph") != "i");  // nothing was dropped
  }
  CHECK(named == static_cast<int>(tracks.size()));
  CHECK(counters > 0);
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
  CHECK_THAT(r.out, Contains("\nstage ") && Contains("ns/item"));
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
  CHECK_THAT(r.out, Contains("(stopped early)") && Contains("\nstage "));
  const Json p = ReadJson(json);
  CHECK(p.at("stopped_early") == true);
  CHECK(p.at("samples") > 0);
  CHECK(p.at("samples") < 640 * 480 * 1000);
}

}  // namespace lanelight
