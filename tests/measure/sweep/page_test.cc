// The page and the table of a sweep hold its cells.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

#include "src/base/core/hash.h"
#include "src/base/stat/efficiency.h"
#include "src/base/stat/values.h"
#include "src/measure/report/page.h"
#include "src/measure/sweep/results.h"
#include "src/render/job/machine_json.h"
#include "tests/base/image/temporary_folder.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Two scenes, one of which has a name that would be markup.
Sweep SyntheticSweep() {
  const TemporaryFolder folder;
  folder.Write("box.pbrt", "");
  folder.Write("<i>odd.pbrt", "");
  return ParseSweep(folder.File("synthetic.toml"), R"([grid]
scene = ["box.pbrt", "<i>odd.pbrt"]
strategy = ["default", "points=halton"]
threads = [1, 2, 4]
spp = [1, 4, 16, 64]
seed = [1, 2]
)");
}

// Three scenes of one name, and a number of strategies as an axis.
Sweep ParameterSweep() {
  const TemporaryFolder folder;
  for (const char* name : {"kitchen", "attic", "cellar"}) {
    std::filesystem::create_directory(folder.File(name));
    folder.Write(std::string(name) + "/reference.pbrt", "");
  }
  return ParseSweep(folder.File("parameters.toml"), R"([grid]
scene = ["kitchen/reference.pbrt", "attic/reference.pbrt", "cellar/reference.pbrt"]
strategy = ["default", "roulette=throughput:{0.05, 0.2, 0.8}", "points=*"]
spp = [4, 16]
seed = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]
)");
}

double Number(const SweepCell& cell, Axis axis) {
  return std::stod(Get(cell.values, axis).value_or("2"));
}

// Different for every text, the same for every run: in [0.8, 1.2).
double FactorOf(const std::string& text) {
  return 0.8 + 0.4 * double(Hash64(text) >> 40) / double(1 << 24);
}

// Some report, different for every cell.
Json SyntheticReport(const SweepCell& cell) {
  const double spp = Number(cell, Axis::kSpp), threads = Number(cell, Axis::kThreads);
  const double seed = Number(cell, Axis::kSeed);
  const std::string strategy = *Get(cell.values, Axis::kStrategy);
  const double points = strategy == "default"         ? 1
                        : strategy == "points=halton" ? 0.7
                                                      : 0.9;
  const double scene = *Get(cell.values, Axis::kScene) == "box.pbrt" ? 1 : 2.5;
  const double samples = spp * 4800;
  const double cpu = (1 + 0.03 * seed) * scene * samples * 1e-6 / points;
  const double seconds = cpu / std::pow(threads, 0.9),
               error = points * scene / spp * seed * FactorOf(cell.name);
  Json report = {
      {"samples", samples},
      {"seconds",
       {{"render", seconds},
        {"load", 0.1},
        {"build", 0.2},
        {"pilot", 0},
        {"write", 0.01}}},
      {"samples_per_second", samples / seconds},
      {"rays", {{"total", 7 * samples}}},
      {"rays_per_second", 7 * samples / seconds},
      {"error", nullptr},
      {"health", {{"nan", 0}, {"infinite", 0}, {"negative", 0}}},
      {"stages",
       {{{"name", "intersect"}, {"seconds", 0.5 * cpu}},
        {{"name", "shade"}, {"seconds", 0.3 * cpu * points}},
        {{"name", "points"}, {"seconds", 0.1 * cpu / seed}}}},
      {"settings", {{"threads", threads}, {"resolution", {80, 60}}}},
      {"sweep", {{"cpu_seconds", cpu}, {"machine", threads > 2 ? "big" : "small"}}}};
  MachineInfo machine;
  machine.processor = threads > 2 ? "Big" : "<b>Small</b>";
  machine.cores = threads > 2 ? 64 : 2;
  machine.load = seed;
  report["machine"] = ToJson(machine);
  if (spp > 1) {
    report["error"] = {
        {"relmse", {{"value", error}, {"low", 0.8 * error}, {"high", 1.3 * error}}},
        {"rmse", {{"value", 0.1 * error}, {"low", 0.09 * error}, {"high", 0.2 * error}}}};
  }
  return report;
}

std::vector<Json> SyntheticCells(const Sweep& sweep) {
  std::vector<Json> cells;
  for (const SweepCell& cell : sweep.cells) {
    CellRecord record = {CellState::kDone, SyntheticReport(cell), ""};
    // One of the last scene has failed, another one is missing.
    if (cell.index + 3 == sweep.cells.size()) {
      record = {CellState::kFailed, {}, "error: out of <i>memory</i>, \"quoted\""};
    }
    if (cell.index + 2 == sweep.cells.size()) record = {};
    cells.push_back(CellJson(cell, record));
  }
  return cells;
}

Json SyntheticJson(const Sweep& sweep) {
  const std::vector<Json> cells = SyntheticCells(sweep);
  return SweepJson(sweep, cells, GroupCells(sweep, cells));
}

// Returns the page with a grey picture of the first cell of each group but the last one.
std::string SyntheticPage(const Sweep& sweep) {
  const std::vector<Json> cells = SyntheticCells(sweep);
  const std::vector<CellGroup> groups = GroupCells(sweep, cells);
  std::map<std::string, ReportImage> pictures;
  for (const CellGroup& group : groups) {
    if (group.cells.empty() || &group == &groups.back()) continue;
    const std::string& name = sweep.cells[group.cells[0]].name;
    pictures[name] = {name, 4, 3, 1, std::vector<float>(12, float(FactorOf(name) / 2))};
  }
  std::vector<ReportImage> images;
  for (const auto& [name, image] : pictures) images.push_back(image);
  Json json = SweepJson(sweep, cells, groups);
  const Json order = {{"value", 0.4}, {"low", 0.2}, {"high", 0.6}};
  json["convergence"] = {{{"values", {{"scene", "box"}, {"strategy", "default"}}},
                          {"order", order},
                          {"fall", "slower"},
                          {"from", 16},
                          {"cause", "heavy-tails"},
                          {"rounding", 1e-16},
                          {"worst_share", 0.5},
                          {"percent_share", 0.7},
                          {"repeated", 0.9},
                          {"pixels", {{{"x", 7}, {"y", 4}, {"share", 0.45}}}},
                          {"text", "the error stops falling as 1/N at 16 spp"}}};
  return ReportPage(PageKind::kSweep, PageJson(json), images);
}

const Json& GroupOf(const Json& json, const Json& values) {
  for (const Json& group : json["groups"]) {
    if (group["values"] == values) return group;
  }
  FAIL("no group " << values);
  return json;
}

void WriteIfAsked(const char* variable, const std::string& page) {
  CHECK(page.size() > 100'000);
  const char* path = std::getenv(variable);
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace

TEST_CASE("sweep: the page contains all cells", "[sweep][report]") {
  const Sweep sweep = SyntheticSweep();
  const Json json = SyntheticJson(sweep);
  REQUIRE(json["cells"].size() == 96);
  CHECK(json["axes"].size() == 4);
  CHECK(json["seeds"] == 2);
  CHECK(json["groups"].size() == 48);
  CHECK(json["stages"] == Json({"intersect", "points", "shade"}));
  const Json& cell = json["cells"][2];
  CHECK(cell["values"]["spp"] == "4");
  CHECK(cell["measured"]["relmse_high"].get<double>() ==
        Approx(1.3 * 0.25 * FactorOf(sweep.cells[2].name)));
  CHECK(cell["stages"][0].get<double>() == Approx(0.5 * 1.03 * 0.0192).epsilon(1e-3));
  CHECK(json["cells"][0]["measured"].value("relmse", Json()).is_null());
  CHECK(json["cells"][93]["status"] == "failed");
  CHECK(json["cells"][94]["status"] == "missing");
  REQUIRE(json["machines"].size() == 2);
  CHECK(json["machines"][0]["text"] ==
        "<b>Small</b>, 2 cores, memory unknown, load 2.00");
  CHECK(json["machines"][1]["processor"] == "Big");
  const std::string page = SyntheticPage(sweep);
  CHECK(page.find("<b>Small") == std::string::npos);
  CHECK(page.find("<i>odd") == std::string::npos);
  CHECK(page.substr(0, 15) == "<!doctype html>");
}

TEST_CASE("sweep: the CSV table quotes commas and quotes", "[sweep]") {
  const Sweep sweep = SyntheticSweep();
  const std::string table = SweepCsv(SyntheticCells(sweep));
  CHECK(table.find(",\"error: out of <i>memory</i>, \"\"quoted\"\"\"\n") !=
        std::string::npos);
  CHECK(std::count(table.begin(), table.end(), '\n') == 97);
  CHECK(table.find("," + MachineCsvHeader() + ",") != std::string::npos);
  CHECK(table.find(",<b>Small</b>,2,,,1.0,") != std::string::npos);
}

TEST_CASE("sweep: strategy patterns are axes, and seeds are repetitions",
          "[sweep][report]") {
  const Sweep sweep = ParameterSweep();
  const Json json = SyntheticJson(sweep);
  std::string names;
  for (const Json& axis : json["axes"]) names += axis["name"].get<std::string>() + " ";
  CHECK(names == "scene strategy points roulette=throughput spp ");
  CHECK(json["axes"][0]["values"] == Json({"kitchen", "attic", "cellar"}));
  CHECK(json["axes"][1]["values"] ==
        Json({"default", "points=*", "roulette=throughput:*"}));
  CHECK(json["axes"][3]["numeric"] == true);
  CHECK(json["axes"][3]["values"] == Json({"0.05", "0.2", "0.8"}));
  CHECK(json["axes"][2]["numeric"] == false);
  // "default" is Sobol': rendered once, and a point of both families.
  const Json& own =
      GroupOf(json, {{"scene", "attic"}, {"strategy", "default"}, {"spp", "16"}});
  const Json& sobol = GroupOf(
      json,
      {{"scene", "attic"}, {"strategy", "points=*"}, {"points", "sobol"}, {"spp", "16"}});
  CHECK(own["cells"] == sobol["cells"]);
  CHECK(own["cells"].size() == 10);
  CHECK(own["efficiency"] == IntervalJson(WithoutBounds(1)));
}

TEST_CASE("sweep: efficiencies are ratios over pairs of equal seeds", "[sweep][report]") {
  const Sweep sweep = ParameterSweep();
  const std::vector<Json> cells = SyntheticCells(sweep);
  const Json json = SyntheticJson(sweep);
  const auto costs = [&](const Json& group) {
    std::map<std::string, stat::Cost> by_seed;
    for (const std::size_t i : group["cells"]) {
      const Json& measured = cells[i]["measured"];
      by_seed[cells[i]["values"]["seed"]] = {measured["relmse"], measured["cpu_seconds"]};
    }
    std::vector<stat::Cost> found;
    for (const auto& [seed, cost] : by_seed) found.push_back(cost);
    return found;
  };
  const Json& baseline =
      GroupOf(json, {{"scene", "cellar"}, {"strategy", "default"}, {"spp", "4"}});
  const Json& other = GroupOf(json, {{"scene", "cellar"},
                                     {"strategy", "roulette=throughput:*"},
                                     {"roulette=throughput", "0.2"},
                                     {"spp", "4"}});
  CHECK(other["strategy"] == "roulette=throughput:0.2");
  const Interval ratio = stat::EfficiencyRatio(costs(baseline), costs(other), 0.95);
  REQUIRE(ratio.HasBounds());
  CHECK(other["efficiency"] == IntervalJson(ratio));
  std::vector<double> rates;
  for (const std::size_t i : other["cells"]) {
    rates.push_back(cells[i]["measured"]["rays_per_second"]);
  }
  CHECK(other["measured"]["rays_per_second"] ==
        IntervalJson(stat::MeanInterval(rates, 0.95)));

  // The last sample count of each scene has a leader among the ten strategies.
  REQUIRE(json["leaders"].size() == 3);
  CHECK(json["leaders"][1]["values"] == Json({{"scene", "attic"}, {"spp", "16"}}));
  std::string best;
  double maximum = 0;
  for (const Json& group : json["groups"]) {
    if (group["values"]["scene"] != "attic" || group["values"]["spp"] != "16") continue;
    if (group["efficiency"]["value"] <= maximum) continue;
    maximum = group["efficiency"]["value"];
    best = group["strategy"];
  }
  CHECK(json["leaders"][1]["best"] == best);
  CHECK(json["leaders"][1]["strategies"] == 7);
  CHECK(json["leaders"][1]["next"] != best);
  CHECK(json["leaders"][1]["next_efficiency"]["value"] <= maximum);
  CHECK(json["leaders"][1]["seeds"] == 10);
}

TEST_CASE("The synthetic sweep can be written", "[sweep][report]") {
  WriteIfAsked("LANELIGHT_SYNTHETIC_SWEEP", SyntheticPage(SyntheticSweep()));
}

TEST_CASE("The synthetic sweep of parameters can be written", "[sweep][report]") {
  WriteIfAsked("LANELIGHT_SYNTHETIC_PARAMETERS", SyntheticPage(ParameterSweep()));
}

}  // namespace lanelight
