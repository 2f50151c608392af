// The page and the table of a sweep hold its cells.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "src/render/machine_json.h"
#include "src/sweep/results.h"
#include "src/sweep/sweep_page.h"
#include "tests/image/temporary_folder.h"

namespace lanelight {
namespace {

using Json = nlohmann::json;

// Two scenes, one of which has a name that would be markup.
Sweep SyntheticSweep() {
  const TemporaryFolder folder;
  folder.Write("box.pbrt", "");
  std::filesystem::create_directory(folder.File("<b>odd<"));
  folder.Write("<b>odd</b>.pbrt", "");
  return ParseSweep(folder.File("synthetic.toml"), R"([grid]
scene = ["box.pbrt", "<b>odd</b>.pbrt"]
strategy = ["default", "points=cmj"]
threads = [1, 2, 4]
spp = [1, 4, 16, 64]
seed = [1, 2]
)");
}

double Number(const SweepCell& cell, Axis axis) {
  return std::stod(Get(cell.values, axis).value());
}

// Some report, different for every cell.
Json SyntheticReport(const SweepCell& cell) {
  const double spp = Number(cell, Axis::kSpp), threads = Number(cell, Axis::kThreads);
  const double seed = Number(cell, Axis::kSeed);
  const double cmj = *Get(cell.values, Axis::kStrategy) == "default" ? 1 : 0.7;
  const double scene = *Get(cell.values, Axis::kScene) == "box.pbrt" ? 1 : 2.5;
  const double samples = spp * 4800;
  const double cpu = (1 + 0.03 * seed) * scene * samples * 1e-6 / cmj;
  const double seconds = cpu / std::pow(threads, 0.9), error = cmj * scene / spp * seed;
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
        {{"name", "shade"}, {"seconds", 0.3 * cpu * cmj}},
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
    // One of the other scene has failed, another one is missing.
    if (cell.index + 3 == sweep.cells.size()) {
      record = {CellState::kFailed, {}, "error: out of <i>memory</i>, \"quoted\""};
    }
    if (cell.index + 2 == sweep.cells.size()) record = {};
    cells.push_back(CellJson(cell, record));
  }
  return cells;
}

}  // namespace

TEST_CASE("sweep: the page has all cells", "[sweep][report]") {
  const Sweep sweep = SyntheticSweep();
  const Json json = SweepJson(sweep, SyntheticCells(sweep));
  REQUIRE(json["cells"].size() == 96);
  CHECK(json["axes"].size() == 5);
  CHECK(json["stages"] == Json({"intersect", "points", "shade"}));
  const Json& cell = json["cells"][2];
  CHECK(cell["values"]["spp"] == "4");
  CHECK(cell["measured"]["relmse_high"].get<double>() == Approx(1.3 * 0.25));
  CHECK(cell["stages"][0].get<double>() == Approx(0.5 * 1.03 * 0.0192).epsilon(1e-3));
  CHECK(json["cells"][0]["measured"].value("relmse", Json()).is_null());
  CHECK(json["cells"][93]["status"] == "failed");
  CHECK(json["cells"][94]["status"] == "missing");
  REQUIRE(json["machines"].size() == 2);
  CHECK(json["machines"][0]["text"] ==
        "<b>Small</b>, 2 cores, memory unknown, load 2.00");
  CHECK(json["machines"][1]["processor"] == "Big");
  const std::string page = SweepPage(sweep, SyntheticCells(sweep));
  CHECK(page.find("<b>Small") == std::string::npos);
  CHECK(page.find("<b>odd") == std::string::npos);
  CHECK(page.substr(0, 15) == "<!doctype html>");
}

TEST_CASE("sweep: the table quotes what commas and quotes would break", "[sweep]") {
  const Sweep sweep = SyntheticSweep();
  const std::string table = SweepCsv(SyntheticCells(sweep));
  CHECK(table.find(",\"error: out of <i>memory</i>, \"\"quoted\"\"\"\n") !=
        std::string::npos);
  CHECK(std::count(table.begin(), table.end(), '\n') == 97);
  CHECK(table.find("," + MachineCsvHeader() + ",") != std::string::npos);
  CHECK(table.find(",<b>Small</b>,2,,,1.0,") != std::string::npos);
}

TEST_CASE("The synthetic sweep can be written", "[sweep][report]") {
  const char* path = std::getenv("LANELIGHT_SYNTHETIC_SWEEP");
  const Sweep sweep = SyntheticSweep();
  const std::string page = SweepPage(sweep, SyntheticCells(sweep));
  CHECK(page.size() > 100'000);
  if (path == nullptr) return;
  std::ofstream file(path, std::ios::binary);
  file << page;
  REQUIRE(file.flush().good());
}

}  // namespace lanelight
